# SPDX-License-Identifier: Apache-2.0
"""Runs one node as a process, from the first right asked for to the last message sent."""

from collections.abc import Callable, Sequence
import sys
import time
import traceback
from typing import Any

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.experimental import EventsExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.signals import SignalHandlerOptions

from srnn_node.access import MEANING, PARAMETER
from srnn_node.command_line import read_command_line, usage
from srnn_node.errors import NodeError
from srnn_node.lifecycle import STARTING, WorkspaceNode
from srnn_node.loop import Loop
from srnn_node.next_step import next_step
from srnn_node.realtime import request_realtime
from srnn_node.settling import Settling, matched_endpoints
from srnn_node.signals import StopRequest

GRACE_S = 0.1
"""How long the middleware gets to send the last messages [s]."""

LOOK_S = 0.05
"""Time between two looks at who has been found [s]."""


def run(
    node_class: type[WorkspaceNode], args: Sequence[str] | None = None, *, priority: int = 0
) -> int:
    """Run a node until it is shut down, signalled or broken.

    SIGINT and SIGTERM deactivate, clean up and shut down the node in this order, so
    that its last command still goes out.

    Args:
        node_class: node to create; its constructor takes no argument.
        args: command line including the program name; None for that of the process.
        priority: SCHED_FIFO priority to ask for, 0 for none; see `srnn_node.realtime`.

    Returns:
        Exit code: 0 after an orderly end, 1 after a fatal error, 2 for a wrong command line.

    """
    command_line = list(sys.argv if args is None else args)
    purpose = node_class.__doc__ or node_class.__name__
    common = {**STARTING, PARAMETER: MEANING}
    words = usage(purpose, node_class.PARAMETERS, common)
    code = read_command_line(command_line, node_class.__name__, words)
    if code is not None:
        return code
    with StopRequest() as stop:
        try:
            _live(node_class, command_line, stop, priority)
        except Exception as error:
            if not isinstance(error, NodeError):
                traceback.print_exception(error)
            print(f'{node_class.__name__}: {str(error) or repr(error)}', file=sys.stderr)
            return 1
        finally:
            rclpy.try_shutdown()
    return 0


def _live(
    node_class: type[WorkspaceNode], command_line: list[str], stop: StopRequest, priority: int
) -> None:
    scheduling = request_realtime(priority)
    created = time.monotonic()
    node = _create(node_class, command_line)
    if not scheduling.granted:
        node.get_logger().warning(scheduling.words)
    executor = EventsExecutor()
    executor.add_node(node)
    loop = Loop(node, executor)
    try:
        if node.get_parameter('autostart').value:
            _start(node, executor, stop, created)
        told = ''
        while stop.name is None and (state := node.state) != 'finalized':
            if state != told:
                told = state
                _tell(node)
            loop.turn()
    finally:
        _wind_down(node, executor)
        executor.shutdown()
        node.destroy_node()


def _create(node_class: Any, command_line: list[str]) -> WorkspaceNode:
    try:
        rclpy.init(args=command_line, signal_handler_options=SignalHandlerOptions.NO)
        node: WorkspaceNode = node_class()
    except (rclpy_implementation.RCLError, ParameterException) as error:
        raise NodeError(f'cannot be created: {error}') from error
    return node


def _start(node: WorkspaceNode, executor: Any, stop: StopRequest, created: float) -> None:
    _change(node, node.trigger_configure)
    if node.get_parameter('paused').value:
        return
    # Whoever is there, a recorder above all, must hear the first word as the others do.
    settling = Settling(created, time.monotonic())
    while not settling.done(matched_endpoints(node), time.monotonic()):
        _spin(executor, LOOK_S)
        if stop.name is not None or node.state != 'inactive':
            return
    _change(node, node.trigger_activate)


def _change(node: WorkspaceNode, trigger: Callable[[], TransitionCallbackReturn]) -> None:
    if trigger() != TransitionCallbackReturn.SUCCESS:
        raise NodeError(node.failure)


def _tell(node: WorkspaceNode) -> None:
    words = next_step(node)
    if words:
        node.get_logger().info(words)
    else:
        # The log is for what somebody has to do something about.
        print(f'{node.get_fully_qualified_name()} is {node.state}', flush=True)


def _wind_down(node: WorkspaceNode, executor: Any) -> None:
    steps = {
        'active': node.trigger_deactivate,
        'inactive': node.trigger_cleanup,
        'unconfigured': node.trigger_shutdown,
    }
    while node.state in steps:
        was = node.state
        steps[was]()
        if was == 'active':
            _spin(executor, GRACE_S)


def _spin(executor: Any, seconds: float) -> None:
    end = time.monotonic() + seconds
    while (left := end - time.monotonic()) > 0.0:
        executor.spin_once(timeout_sec=left)
