# SPDX-License-Identifier: Apache-2.0
"""This process as a node of the graph that it watches or asks."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
import os
from pathlib import Path

import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from srnn_bringup.config import ROOT
from srnn_bringup.dds_security.enclaves import COMMAND
from srnn_bringup.environment import graph_environment, security_arguments
from srnn_bringup.errors import SecurityError
from srnn_bringup.pump import Pump


@contextmanager
def session(
    name: str,
    guard: Callable[[], None],
    keystore: Path | None = None,
    namespace: str = ROOT,
) -> Iterator[tuple[Node, Pump]]:
    """Take part in the middleware; yield the node, and the pump that handles its events.

    The environment of this process is that of the graph meanwhile.

    Args:
        name: name of the node.
        guard: raises when it is time to stop.
        keystore: keystore that protects the graph, None for none.
        namespace: absolute ROS namespace of the graph.

    Raises:
        SecurityError: the middleware does not let this process in.

    """
    before = dict(os.environ)
    os.environ.update(graph_environment(os.environ, keystore))
    with ExitStack() as stack:
        stack.callback(_restore, before)
        stack.callback(rclpy.try_shutdown)
        node = _enter(name, keystore, namespace)
        stack.callback(node.destroy_node)
        executor = EventsExecutor()
        stack.callback(executor.shutdown)
        executor.add_node(node)
        yield node, Pump(executor, guard)


def _enter(name: str, keystore: Path | None, namespace: str) -> Node:
    try:
        rclpy.init(
            args=security_arguments(COMMAND, keystore),
            signal_handler_options=SignalHandlerOptions.NO,
        )
        return Node(
            name, namespace=namespace, enable_rosout=False, start_parameter_services=False
        )
    except rclpy_implementation.RCLError as error:
        raise SecurityError(f'the middleware does not let {name} in: {error}') from error


def _restore(environ: Mapping[str, str]) -> None:
    os.environ.clear()
    os.environ.update(environ)
