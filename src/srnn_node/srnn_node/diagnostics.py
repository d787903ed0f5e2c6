# SPDX-License-Identifier: Apache-2.0
"""Tells the health of a node once a second."""

from collections.abc import Callable

from rclpy.node import Node

from srnn_msgs_py.health import Health
from srnn_msgs_py.ros import diagnostics
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic

PERIOD_S = 1.0


class HealthReporter:
    """Publishes one status on /diagnostics, in every state of the lifecycle."""

    def __init__(self, node: Node, read: Callable[[], Health]) -> None:
        """Report on `node` what `read` returns."""
        row = topic('/diagnostics')
        self._node = node
        self._read = read
        self._publisher = node.create_publisher(
            message_type(row.type_name), row.name, profile(row.qos)
        )
        self._timer = node.create_timer(PERIOD_S, self.report)

    def report(self) -> None:
        """Publish the status now."""
        node = self._node
        name = node.get_fully_qualified_name()
        stamp_ns = node.get_clock().now().nanoseconds
        self._publisher.publish(diagnostics.to_msg(self._read(), name, stamp_ns))
