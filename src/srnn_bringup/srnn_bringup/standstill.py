# SPDX-License-Identifier: Apache-2.0
"""Tells when the arm has come to rest, from the poses of its tip."""

from collections import deque
import time

import numpy as np
from rclpy.node import Node

from srnn_msgs_py.ros import pose
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.tip import TipPosition
from srnn_msgs_py.topics import topic

SPAN_S = 0.4
"""It has been at rest for so long [s]."""

STILL_M = 0.0005
"""A tip that holds its place is measured within this [m]."""


class Standstill:
    """True when called while the tip has not moved for a while."""

    def __init__(self, node: Node) -> None:
        """Listen with `node`."""
        self._tips: deque[tuple[float, np.ndarray]] = deque()
        row = topic('current_pose')
        node.create_subscription(
            message_type(row.type_name), row.name, lambda msg: self.take(
                pose.from_msg(msg), time.monotonic()
            ), profile(row.qos),
        )  # fmt: skip

    def take(self, tip: TipPosition, now: float) -> None:
        """Take in a measured tip at a time of a steady clock [s]."""
        self._tips.append((now, tip.position))
        while len(self._tips) > 2 and now - self._tips[1][0] >= SPAN_S:
            self._tips.popleft()

    def __call__(self) -> bool:
        """Tell whether the tip has moved less than its noise during the last `SPAN_S`."""
        if not self._tips or self._tips[-1][0] - self._tips[0][0] < SPAN_S:
            return False
        positions = np.array([position for _, position in self._tips])
        return bool(np.ptp(positions, axis=0).max() < STILL_M)
