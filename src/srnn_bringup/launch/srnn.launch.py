# SPDX-License-Identifier: Apache-2.0
"""The graph of `srnn up` for a machine with ROS 2: ros2 launch srnn_bringup srnn.launch.py."""

from pathlib import Path
import tempfile

from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import LifecycleNode

from srnn_bringup.arms import ARMS
from srnn_bringup.config import SIMULATED, STANDARD_SCENE, Choices, load
from srnn_bringup.graph import access, chosen, part, write_parameters
from srnn_planner.core.dissonance import SIGNALS

RESPAWN_S = 1.0
"""Pause until a node that has died is started anew [s]."""

ARGUMENTS = {
    'arm': (SIMULATED, list(ARMS), 'arm to move'),
    'emulator': ('false', ['false', 'true'], 'with arm:=fri: emulate the controller'),
    'scene': (STANDARD_SCENE, None, 'name of a scene in config/scenes, or path of a scene file'),
    'signal': ('', ['', *SIGNALS], 'learning signal; empty for the one of network.yaml'),
    'seed': ('0', None, 'seed of all random numbers'),
    'key': ('', None, 'file with the key that the nodes share; empty for none'),
    'only': ('', None, 'nodes to start; empty for all'),
}
"""Default, choices and meaning of every argument."""


def generate_launch_description() -> LaunchDescription:
    """Return the arguments, and the nodes that follow from them."""
    arguments = [
        DeclareLaunchArgument(name, default_value=value, choices=choices, description=text)
        for name, (value, choices, text) in ARGUMENTS.items()
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=launch_nodes)])


def launch_nodes(context: LaunchContext) -> list[LifecycleNode]:
    """Check the configuration, then return the nodes; each brings itself up."""
    given = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    choices = Choices(
        arm=given['arm'],
        emulated=given['emulator'] == 'true',
        scene=given['scene'],
        signal=given['signal'] or None,
        seed=int(given['seed']),
        key_file=Path(given['key']) if given['key'] else None,
    )
    only = part(given['only']) if given['only'] else ()
    configuration = load(choices)
    # The directory outlives this function: the nodes read its files when they start.
    directory = Path(tempfile.mkdtemp(prefix='srnn_'))
    nodes = chosen(configuration, only, directory)
    files = write_parameters(nodes, directory, autostart=True, **access(configuration))
    return [
        LifecycleNode(
            name=node.name,
            namespace='',
            package=node.package,
            executable=node.executable,
            parameters=[str(files[node.name])],
            output='screen',
            respawn=True,
            respawn_delay=RESPAWN_S,
        )
        for node in nodes
    ]
