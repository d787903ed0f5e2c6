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
from srnn_replay.joint_state_bytes import (
    FIELDS,
    JointStateBytes,
    last_numbers,
    stamp_ns,
    stamps_ns,
)

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
    assert stamps_ns(messages).tolist() == [sample.stamp_ns for sample, _ in written for _ in '12']
    for fields in (FIELDS, ('effort',), ('position', 'effort')):
        known, numbers = READER.columns(messages, fields)
        for there, read, values in zip(known, numbers, expected, strict=True):
            wanted = [values[FIELDS.index(field)] for field in fields]
            assert there == all(len(value) == 7 for value in wanted)
            assert not there or read.tobytes() == np.array(wanted).tobytes()


def test_other_names_and_garbage_are_left_to_the_general_way():
    rest = np.zeros(7)
    msg, _ = joints.to_msgs(JointSample(1, rest, rest, rest, rest), JOINT_NAMES)
    data = bytes(serialize_message(msg))
    assert not JointStateBytes(JOINT_NAMES[::-1]).columns([data])[0].any()
    pieces = [data[:length] for length in range(len(data) - 56)]
    known, numbers = READER.columns(pieces)
    assert not known.any()
    assert np.isnan(numbers).all()


def test_what_is_not_known_does_not_keep_its_neighbours_from_being_read():
    rest = np.zeros(7)
    msg, _ = joints.to_msgs(JointSample(1, rest, rest, rest, rest), JOINT_NAMES)
    data = bytes(serialize_message(msg))
    other = data.replace(JOINT_NAMES[3].encode(), b'x' * len(JOINT_NAMES[3]))
    known, _ = READER.columns([other, data, other])
    assert known.tolist() == [False, True, False]


def test_what_is_too_short_for_a_stamp_does_not_shift_the_stamps_of_others():
    rest = np.zeros(7)
    msg, _ = joints.to_msgs(JointSample(123 * 10**9 + 456, rest, rest, rest, rest), JOINT_NAMES)
    data = bytes(serialize_message(msg))
    for length in range(12):
        assert stamps_ns([data, data[:length], data]).tolist()[::2] == [123 * 10**9 + 456] * 2


def test_the_last_numbers_are_read_from_even_and_uneven_messages():
    one, two = np.arange(7.0), np.arange(7.0, 14.0)
    messages = [b'head' + one.tobytes(), b'longer head' + two.tobytes()]
    for read, written in zip(last_numbers(messages, 7), (one, two), strict=True):
        np.testing.assert_array_equal(read, written)
    short = [*messages, one[:3].tobytes()]
    assert [len(read) for read in last_numbers(short, 7)] == [7, 7, 3]
