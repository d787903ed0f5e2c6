# SPDX-License-Identifier: Apache-2.0
from array import array

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseWithCovariance
from hypothesis import given
from hypothesis import strategies as st
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Empty, Float64MultiArray, Header, String

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros.canonical import canonical
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.topics import TOPICS

SHORT = st.text('ab', max_size=3)
NAMES = st.lists(SHORT, max_size=3)
NUMBERS = st.lists(st.sampled_from([0.0, -0.0, 1.0]), max_size=3)
STATES = st.builds(
    lambda sec, frame, name, position, effort: JointState(
        header=Header(stamp=Time(sec=sec), frame_id=frame), name=name,
        position=array('d', position), effort=array('d', effort),
    ),
    st.integers(0, 2), SHORT, NAMES, NUMBERS, NUMBERS,
)  # fmt: skip


@given(STATES, STATES)
def test_messages_have_equal_bytes_exactly_if_they_are_equal(one, other):
    """Nothing at the end of a field can be taken for the beginning of the next."""
    # Comparison takes -0 for 0, its text does not.
    assert (canonical(one) == canonical(other)) == (repr(one) == repr(other))


@given(STATES)
def test_bytes_are_the_same_on_the_other_side_of_the_wire(state):
    arrived = deserialize_message(serialize_message(state), JointState)
    assert canonical(arrived) == canonical(state)


@pytest.mark.parametrize('row', TOPICS, ids=lambda row: row.name)
def test_messages_of_every_topic_have_bytes(row):
    assert canonical(message_type(row.type_name)())


def test_numbers_keep_every_bit():
    one, other = (Float64MultiArray(data=array('d', [value])) for value in (0.0, -0.0))
    assert canonical(one) != canonical(other)
    pose = PoseWithCovariance()
    before = canonical(pose)
    pose.covariance[35] = 5e-324
    assert canonical(pose) != before


def test_lists_of_messages_and_single_octets_are_covered():
    def status(level, *pairs):
        values = [KeyValue(key=key, value=value) for key, value in pairs]
        return canonical(DiagnosticStatus(level=level, values=values))

    texts = {
        status(b'\0'), status(b'\1'), status(b'\0', ('', '')), status(b'\0', ('a', '')),
        status(b'\0', ('', 'a')), status(b'\0', ('', ''), ('', '')),
    }  # fmt: skip
    assert len(texts) == 6


def test_text_that_is_no_text_has_bytes_too():
    assert canonical(String(data='\udcff')) != canonical(String(data='\udcfe'))


def test_small_messages_have_bytes():
    assert canonical(Bool(data=True)) != canonical(Bool(data=False))
    assert canonical(Empty()) == canonical(Empty())


class Wide:
    data = 'x'

    @staticmethod
    def get_fields_and_field_types():
        return {'data': 'wstring'}


def test_a_type_that_no_message_here_has_is_refused_by_name():
    with pytest.raises(MessageError, match="'wstring' cannot be turned into bytes"):
        canonical(Wide())
