# SPDX-License-Identifier: Apache-2.0
"""The short way reads what the middleware writes, or says that it cannot."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
from rclpy.serialization import serialize_message

from lwr_description import JOINT_NAMES
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import joints
from srnn_msgs_py.ros.mark_carrier import mark_carrier
from srnn_replay.joint_state_bytes import JointStateBytes, stamp_ns

READER = JointStateBytes(JOINT_NAMES)
angles = st.lists(st.floats(allow_nan=False), min_size=7, max_size=7).map(np.array)
stamps = st.integers(0, 2**31 * 10**9 - 1)


@given(stamps, angles, angles, angles, st.text('0123456789abc', max_size=70))
def test_it_reads_what_was_written(stamp, one, two, three, mark):
    for msg, expected in zip(
        joints.to_msgs(JointSample(stamp, one, two, three, two), JOINT_NAMES),
        ([one, two, three], [[], [], two]),
        strict=True,
    ):
        if mark:
            mark_carrier(type(msg)).put(msg, mark)
        data = bytes(serialize_message(msg))
        assert stamp_ns(data) == stamp
        for read, written in zip(READER.arrays(data), expected, strict=True):
            assert read.tobytes() == np.array(written, dtype=float).tobytes()


def test_other_names_and_garbage_are_left_to_the_general_way():
    rest = np.zeros(7)
    msg, _ = joints.to_msgs(JointSample(1, rest, rest, rest, rest), JOINT_NAMES)
    data = bytes(serialize_message(msg))
    assert JointStateBytes(JOINT_NAMES[::-1]).arrays(data) is None
    for length in range(len(data) - 56):
        assert READER.arrays(data[:length]) is None
