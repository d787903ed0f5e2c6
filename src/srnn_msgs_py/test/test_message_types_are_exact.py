# SPDX-License-Identifier: Apache-2.0
"""A float field that holds an int or a numpy scalar arrives as garbage, silently."""

import numpy as np

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import Health
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import (
    commands,
    diagnostics,
    dissonance,
    executed,
    joints,
    path,
    pose,
    refusal,
    result,
    segment,
    waypoints,
    weights,
    wrench,
)
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.tip import TipPosition
from srnn_msgs_py.waypoints import Waypoints
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_msgs_py.wrench import Wrench

STAMP = np.int64(1_795_000_000_000_000_001)
WHOLE = np.arange(6).reshape(3, 2)
SINGLE = WHOLE.astype(np.float32)
TIMES = np.arange(3, dtype=np.float32)
NAMES = ('a', 'b')
LEARNED = LearnedWeights(np.int32(3), np.uint32(7), WHOLE[:, 1], np.array([1, 0, -1]))


def messages():
    """Every message of the package, made of sloppy numbers."""
    yield segment.to_msg(Segment(STAMP, TIMES, WHOLE, SINGLE, WHOLE))
    yield executed.to_msg(ExecutedPath(STAMP, TIMES, SINGLE))
    yield path.to_msg(ExecutedPath(STAMP, TIMES, SINGLE))
    yield from joints.to_msgs(JointSample(STAMP, WHOLE[0], SINGLE[0], WHOLE[1], SINGLE[1]), NAMES)
    yield commands.to_msg(WHOLE[0])
    yield weights.to_msg(WeightsUpdate(np.int32(3), STAMP, LEARNED))
    yield refusal.to_msg(WeightsRefusal(np.int32(3), np.int64(2), np.str_('dead')))
    yield dissonance.to_msg(
        Dissonance(
            STAMP, np.str_('local'), np.True_, np.int32(2), np.float32(0.25), TIMES, TIMES, 3
        )
    )
    yield result.to_msg(SegmentResult(STAMP, ResultCode.DONE, values={'force_n': np.float32(2)}))
    yield waypoints.to_msg(Waypoints(STAMP, WHOLE))
    yield pose.to_msg(TipPosition(STAMP, np.arange(3)))
    yield wrench.to_msg(Wrench(STAMP, 'tool', np.arange(3), np.arange(3, dtype=np.float32)))
    yield diagnostics.to_msg(Health(values={'ticks': np.int64(4)}), 'node', STAMP)


def test_sloppy_numbers_arrive_as_the_same_numbers(wire):
    for msg in messages():
        assert msg._check_fields, 'this test needs ROS_PYTHON_CHECK_FIELDS=1'
        assert wire(msg) == msg
