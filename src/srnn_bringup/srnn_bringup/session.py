# SPDX-License-Identifier: Apache-2.0
"""This process as a node of the graph that it watches or asks."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
import os

import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from srnn_bringup.environment import graph_environment
from srnn_bringup.pump import Pump


@contextmanager
def session(name: str, guard: Callable[[], None]) -> Iterator[tuple[Node, Pump]]:
    """Take part in the middleware; yield the node, and the pump that handles its events.

    Args:
        name: name of the node.
        guard: raises when it is time to stop.

    """
    os.environ.update(graph_environment(os.environ))
    with ExitStack() as stack:
        rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
        stack.callback(rclpy.try_shutdown)
        node = Node(name, enable_rosout=False, start_parameter_services=False)
        stack.callback(node.destroy_node)
        executor = EventsExecutor()
        stack.callback(executor.shutdown)
        executor.add_node(node)
        yield node, Pump(executor, guard)
