# SPDX-License-Identifier: Apache-2.0
"""The graph of `srnn up` for a machine with ROS 2: ros2 launch srnn_bringup srnn.launch.py."""

from collections.abc import Sequence
import os
from pathlib import Path
import sys
import tempfile
from typing import Any

from launch import Action, LaunchContext, LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    ExecuteProcess,
    OpaqueFunction,
    RegisterEventHandler,
)
from launch.event_handlers import OnProcessIO
from launch.events.process import ProcessIO
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import LifecycleNode, Node

from srnn_bringup import viewer
from srnn_bringup.config import ROOT, Configuration
from srnn_bringup.dds_security.enclaves import COMMAND
from srnn_bringup.environment import graph_environment, security_arguments
from srnn_bringup.graph import access, chosen, write_parameters
from srnn_bringup.graph_options import configuration
from srnn_bringup.launch_arguments import launch_arguments, read_arguments, refuse_unknown
from srnn_bringup.node_description import NodeDescription
from srnn_bringup.record import RECORDING

RESPAWN_S = 1.0
"""Pause until a node that has died is started anew [s]."""


def generate_launch_description() -> LaunchDescription:
    """Return the arguments, and the processes that follow from them."""
    arguments = [
        DeclareLaunchArgument(
            argument.name, default_value=argument.default, description=argument.meaning,
            choices=argument.choices and list(argument.choices),
        )
        for argument in launch_arguments()
    ]  # fmt: skip
    check = OpaqueFunction(function=check_names)
    return LaunchDescription([check, *arguments, OpaqueFunction(function=launch_processes)])


def check_names(context: LaunchContext) -> None:
    """Refuse arguments that nobody knows, unless another launch file may know them."""
    if any(Path(word).name == Path(__file__).name for word in sys.argv):
        refuse_unknown(word.partition(':=')[0] for word in context.argv)


def launch_processes(context: LaunchContext) -> list[Action]:
    """Check the configuration, then return all processes; each node brings itself up."""
    options = read_arguments(
        {a.name: LaunchConfiguration(a.name).perform(context) for a in launch_arguments()}
    )
    around = context.launch_configurations
    options.namespace = joined(around.get('ros_namespace', ROOT), options.namespace)
    told = configuration(options)
    # The directory outlives this function: the nodes read its files when they start.
    directory = Path(tempfile.mkdtemp(prefix='srnn_'))
    descriptions = chosen(told, options.only, directory)
    files = write_parameters(descriptions, directory, autostart=True, **access(told))
    # Those around are out of force by the time at which a recorded graph is started.
    remappings = [*around.get('ros_remaps', ()), *told.remappings]
    processes: list[Action] = [
        LifecycleNode(
            respawn=True, respawn_delay=RESPAWN_S, name=node.name, remappings=remappings,
            **common(node, files[node.name], told),
        )
        for node in descriptions
    ]  # fmt: skip
    if options.view is not None:
        page = viewer.describe(told, options.view)
        file = write_parameters([page], directory)[page.name]
        processes.append(Node(name=page.name, **common(page, file, told, member=COMMAND)))
    if options.record is None:
        return processes
    return recorded(options.record, told, remappings, processes)


def common(
    node: NodeDescription, parameters: Path, told: Configuration, member: str | None = None
) -> dict[str, Any]:
    """Return what launch is told of every node; its enclave is that of `member`, if any."""
    return {
        'namespace': told.namespace,
        'package': node.package,
        'executable': node.executable,
        'parameters': [str(parameters)],
        'arguments': security_arguments(member or node.name, told.keystore),
        'additional_env': graph_environment(os.environ, told.keystore),
        'output': 'screen',
    }


def recorded(
    bag: Path,
    told: Configuration,
    remappings: Sequence[tuple[str, str]],
    processes: list[Action],
) -> list[Action]:
    """Return a recorder that has the processes started as soon as it records."""
    rights = [] if told.keystore is None else ['--secure', str(told.keystore)]
    rules = ','.join(f'{name}:={other}' for name, other in remappings)
    names = ['--remap', rules] if rules else []
    command = [sys.executable, '-m', 'srnn_bringup.cli', 'record', str(bag)]
    recorder = ExecuteProcess(
        cmd=[*command, '--namespace', told.namespace, *names, *rights], name='record',
        output='screen',
    )

    def start(event: ProcessIO) -> list[Action] | None:
        return processes if RECORDING in event.text.decode() else None

    handler = OnProcessIO(target_action=recorder, on_stdout=start)
    return [RegisterEventHandler(handler), recorder]


def joined(outer: str, inner: str) -> str:
    """Return a namespace inside another one, both absolute."""
    return f'{outer.rstrip("/")}/{inner.strip("/")}'.rstrip('/') or ROOT
