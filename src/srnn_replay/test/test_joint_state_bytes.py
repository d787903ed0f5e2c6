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


samples = st.builds(JointSample, stamps, angles, angles, angles, angles)
marks = st.text('0123456789abc', max_size=70)


@given(st.lists(st.tuples(samples, marks), max_size=6))
def test_it_reads_what_was_written(written):
    messages, expected = [], []
    for sample, mark in written:
        for msg, values in zip(
            joints.to_msgs(sample, JOINT_NAMES),
            (
                [sample.position, sample.velocity, sample.torque],
                [[], [], sample.external_torque],
            ),
            strict=True,
        ):
            if mark:
                mark_carrier(type(msg)).put(msg, mark)
            messages.append(bytes(serialize_message(msg)))
            expected.append(values)
            assert stamp_ns(messages[-1]) == sample.stamp_ns
    for read, values in zip(READER.rows(messages), expected, strict=True):
        for one, other in zip(read, values, strict=True):
            assert one.tobytes() == np.array(other, dtype=float).tobytes()


def test_other_names_and_garbage_are_left_to_the_general_way():
    rest = np.zeros(7)
    msg, _ = joints.to_msgs(JointSample(1, rest, rest, rest, rest), JOINT_NAMES)
    data = bytes(serialize_message(msg))
    assert JointStateBytes(JOINT_NAMES[::-1]).rows([data]) == [None]
    pieces = [data[:length] for length in range(len(data) - 56)]
    assert READER.rows(pieces) == [None] * len(pieces)


def test_what_is_not_known_does_not_keep_its_neighbours_from_being_read():
    rest = np.zeros(7)
    msg, _ = joints.to_msgs(JointSample(1, rest, rest, rest, rest), JOINT_NAMES)
    data = bytes(serialize_message(msg))
    other = data.replace(JOINT_NAMES[3].encode(), b'x' * len(JOINT_NAMES[3]))
    first, second, third = READER.rows([other, data, other])
    assert first is third is None
    assert second is not None
