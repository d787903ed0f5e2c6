# SPDX-License-Identifier: Apache-2.0
"""What a tracker tells: commands, executed paths, results, and where the tip is."""

import numpy as np
from numpy.typing import NDArray

from lwr_tracking.core.refusal import NOT_IN_CHARGE
from lwr_tracking.core.tracker import Tick
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import commands, executed, pose, result
from srnn_msgs_py.segment import Segment
from srnn_msgs_py.tip import TipPosition
from srnn_node.lifecycle import WorkspaceNode

TICKS_PER_POSE = 5
"""One pose goes out for this many measurements: 50 Hz of 250 Hz."""


class TrackerTopics:
    """Converts and publishes.

    Attributes:
        commands: publisher of the joint commands.
        ticks: measurements answered so far.

    """

    def __init__(self, node: WorkspaceNode) -> None:
        """Connect to the topics of `node`, which is being configured."""
        self.ticks = 0
        self.commands = node.advertise('forward_position_controller/commands')
        self._executed = node.advertise('executed')
        self._results = node.advertise('segment_result')
        self._pose = node.advertise('current_pose')

    def answer(self, tick: Tick, stamp_ns: int, tip: NDArray[np.float64]) -> None:
        """Tell what a measurement has brought about.

        Args:
            tick: the command, and segments that are over.
            stamp_ns: time of the measurement [ns of ROS time].
            tip: (3,) where the tip was [m]; told now and then.

        """
        if tick.command is not None:
            self.commands.publish(commands.to_msg(tick.command))
        for end in tick.finished:
            if end.path is not None:
                self._executed.publish(executed.to_msg(end.path))
            self.result(end.result)
        self.ticks += 1
        if self.ticks % TICKS_PER_POSE == 0:
            self._pose.publish(pose.to_msg(TipPosition(stamp_ns, tip)))

    def result(self, value: SegmentResult) -> None:
        """Tell what has become of a segment."""
        self._results.publish(result.to_msg(value))

    def not_in_charge(self, segment: Segment) -> None:
        """Tell a planner that it has to wait, so that it need not find out by itself."""
        code = ResultCode.REJECTED
        self.result(SegmentResult(segment.stamp_ns, code, NOT_IN_CHARGE, {}))
