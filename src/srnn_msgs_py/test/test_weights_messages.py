# SPDX-License-Identifier: Apache-2.0
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Float32MultiArray, MultiArrayDimension

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros import layout
from srnn_msgs_py.ros import weights as weight_messages
from srnn_msgs_py.weights import MAX_VERSION, WeightsUpdate, checksum

STAMP = 1_795_000_000_123_456_789
WHOLE = st.integers(0, 2**63 - 1)
TEXT = st.text(st.characters(codec='utf-8', exclude_characters='\0'), max_size=30)


@st.composite
def any_weights(draw):
    count = draw(st.integers(1, 12))
    elements = st.floats(-1.0, 1.0, width=32)
    matrix = draw(hnp.arrays(np.float32, (count, count), elements=elements))
    return WeightsUpdate(draw(st.integers(0, MAX_VERSION)), draw(WHOLE), matrix)


def message(count=4):
    matrix = np.linspace(-1.0, 1.0, count * count, dtype=np.float32).reshape(count, count)
    return weight_messages.to_msg(WeightsUpdate(7, STAMP, matrix))


@given(any_weights())
def test_weights_come_back_from_the_wire_bit_for_bit(weights):
    sent = serialize_message(weight_messages.to_msg(weights))
    back = weight_messages.from_msg(deserialize_message(sent, Float32MultiArray))
    assert back.version == weights.version
    assert back.segment_stamp_ns == weights.segment_stamp_ns
    assert back.matrix.dtype == np.float32
    np.testing.assert_array_equal(back.matrix, weights.matrix)


def test_received_weights_cannot_be_changed():
    with pytest.raises(ValueError, match='read-only'):
        weight_messages.from_msg(message()).matrix[0, 0] = 0.5


@given(st.integers(0, 15), st.integers(0, 31))
def test_one_flipped_bit_is_noticed(index, bit):
    msg = message()
    raw = np.frombuffer(msg.data, np.uint32)
    raw[index] ^= np.uint32(1 << bit)
    with pytest.raises(MessageError):
        weight_messages.from_msg(msg)


@pytest.mark.parametrize(('label', 'forged'), [('version', '8'), ('segment_stamp_ns', '1')])
def test_the_checksum_covers_the_identity(label, forged):
    msg = message()
    dim = next(d for d in msg.layout.dim if d.label.startswith(label))
    dim.label = f'{label}={forged}'
    with pytest.raises(MessageError, match='crc32'):
        weight_messages.from_msg(msg)


@pytest.mark.parametrize('value', [np.nan, np.inf, -np.inf, 1.001, -2.0])
def test_impossible_weights_are_neither_sent_nor_taken(value):
    matrix = np.zeros((3, 3), np.float32)
    matrix[1, 2] = value
    bad = WeightsUpdate(1, STAMP, matrix)
    with pytest.raises(MessageError, match='must be'):
        weight_messages.to_msg(bad)
    msg = message(3)
    msg.data = type(msg.data)('f', matrix.ravel().tolist())
    with pytest.raises(MessageError, match='must be'):
        weight_messages.from_msg(msg)


def test_half_a_message_is_refused():
    msg = message()
    msg.data = msg.data[:8]
    with pytest.raises(MessageError, match='data has 8 values: the layout says 16'):
        weight_messages.from_msg(msg)


@pytest.mark.parametrize('shape', [(2, 3), (3, 2), (0, 0), (2,), (2, 2, 2)])
def test_weights_that_are_not_square_are_refused(shape):
    with pytest.raises(MessageError, match='must be square and not empty'):
        weight_messages.to_msg(WeightsUpdate(1, STAMP, np.zeros(shape, np.float32)))


def test_layouts_of_other_people_are_refused_by_name():
    plain = Float32MultiArray(data=[0.0] * 4)
    with pytest.raises(MessageError, match='dims none: must be presynaptic, postsynaptic'):
        weight_messages.from_msg(plain)
    swapped = message()
    swapped.layout.dim[0].label = 'rows'
    with pytest.raises(MessageError, match="dims 'rows', 'postsynaptic'"):
        weight_messages.from_msg(swapped)
    shifted = message()
    shifted.layout.data_offset = 4
    with pytest.raises(MessageError, match='data_offset = 4: must be 0'):
        weight_messages.from_msg(shifted)
    endless = message()
    endless.layout.dim = [MultiArrayDimension(label='x=1')] * 1000
    with pytest.raises(MessageError, match='layout has 1000 dims'):
        weight_messages.from_msg(endless)


@given(TEXT.filter(lambda text: text.lstrip('0') != '7'))
def test_no_text_in_a_label_does_more_than_refuse(text):
    msg = message()
    msg.layout.dim[2].label = f'version={text}'
    with pytest.raises(MessageError):
        weight_messages.from_msg(msg)
    msg.layout.dim[2].label = text
    with pytest.raises(MessageError):
        weight_messages.from_msg(msg)


@pytest.mark.parametrize('neurons', [3, 5])
def test_weights_of_another_network_are_refused_before_they_are_copied(neurons, monkeypatch):
    assert weight_messages.from_msg(message(4), 4).version == 7
    monkeypatch.setattr(np, 'array', None)
    with pytest.raises(MessageError, match=rf'shape \(4, 4\): must be \({neurons}, {neurons}\)'):
        weight_messages.from_msg(message(4), neurons)


def test_huge_messages_are_refused_before_they_are_copied(monkeypatch):
    monkeypatch.setattr(layout, 'MAX_VALUES', 15)
    monkeypatch.setattr(np, 'array', None)
    with pytest.raises(MessageError, match='data has 16 values: must be <= 15'):
        weight_messages.from_msg(message(4))


def test_versions_leave_room_for_later_ones():
    matrix = np.zeros((2, 2), np.float32)
    last = weight_messages.to_msg(WeightsUpdate(MAX_VERSION, STAMP, matrix))
    assert weight_messages.from_msg(last).version == MAX_VERSION
    for version in (-1, MAX_VERSION + 1):
        with pytest.raises(MessageError, match=f'version = {version}: must be'):
            weight_messages.to_msg(WeightsUpdate(version, STAMP, matrix))
    dim = next(d for d in last.layout.dim if d.label.startswith('version'))
    dim.label = f'version={MAX_VERSION + 1}'
    with pytest.raises(MessageError, match='version = 1000000001: must be'):
        weight_messages.from_msg(last)


def test_every_dimension_of_the_layout_multiplies_up_to_the_data():
    msg = message(5)
    sizes = [dim.size for dim in msg.layout.dim]
    assert np.prod(sizes) == len(msg.data)
    assert msg.layout.dim[0].stride == 25
    assert msg.layout.dim[1].stride == 5


def test_the_checksum_is_that_of_the_stated_bytes():
    # CRC-32 of sixteen and twenty zero bytes, from the polynomial's definition.
    def crc(data):
        value = 0xFFFFFFFF
        for byte in data:
            value ^= byte
            for _ in range(8):
                value = (value >> 1) ^ (0xEDB88320 if value & 1 else 0)
        return value ^ 0xFFFFFFFF

    assert checksum(0, 0, np.zeros((1, 1), np.float32)) == crc(bytes(20))
    assert checksum(1, 0, np.zeros((1, 1), np.float32)) == crc(b'\1' + bytes(19))
