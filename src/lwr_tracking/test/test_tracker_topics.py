# SPDX-License-Identifier: Apache-2.0
"""What a tracker has decided goes out in order; where the tip is, now and then."""

import numpy as np
from segments import line

from lwr_tracking.core import Finished, Tick
from lwr_tracking.core.refusal import NOT_IN_CHARGE
from lwr_tracking.tracker_topics import TICKS_PER_POSE, TrackerTopics
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import executed, pose, result
from srnn_msgs_py.segment import ExecutedPath


class Advertising:
    """Stands in for a node; every publisher writes into one list."""

    def __init__(self):
        self.said = []

    def advertise(self, name):
        return type('', (), {'publish': lambda _, msg: self.said.append((name, msg))})()

    def topics(self):
        return [name for name, _ in self.said]


def test_the_command_goes_first_and_a_path_before_its_result():
    node = Advertising()
    path = ExecutedPath(1, np.arange(2.0), np.zeros((2, 2)))
    finished = (
        Finished(SegmentResult(1, ResultCode.BLOCKED), path),
        Finished(SegmentResult(2, ResultCode.REJECTED), None),
    )
    TrackerTopics(node).answer(Tick(np.zeros(7), finished), 5, np.zeros(3))
    assert node.topics() == [
        'forward_position_controller/commands', 'executed', 'segment_result', 'segment_result',
    ]  # fmt: skip
    assert executed.from_msg(node.said[1][1]).stamp_ns == 1
    assert [result.from_msg(msg).stamp_ns for _, msg in node.said[2:]] == [1, 2]


def test_without_a_command_none_goes_out_and_poses_go_on():
    node = Advertising()
    topics = TrackerTopics(node)
    for stamp in range(1, 2 * TICKS_PER_POSE + 1):
        topics.answer(Tick(None, ()), stamp, np.full(3, 0.1))
    assert node.topics() == ['current_pose'] * 2
    stamps = [pose.from_msg(msg).stamp_ns for _, msg in node.said]
    assert stamps == [TICKS_PER_POSE, 2 * TICKS_PER_POSE]


def test_a_planner_that_has_to_wait_is_told():
    node = Advertising()
    TrackerTopics(node).not_in_charge(line((0.0, 0.0), (0.1, 0.0), 0.1, stamp_ns=9))
    ((_, msg),) = node.said
    told = result.from_msg(msg)
    assert (told.stamp_ns, told.code, told.reason) == (9, ResultCode.REJECTED, NOT_IN_CHARGE)
