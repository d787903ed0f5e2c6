# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
import struct

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
from srnn_msgs_py.weights import MAX_VERSION, LearnedWeights, WeightsUpdate

STAMP = 1_795_000_000_123_456_789
WHOLE = st.integers(0, 2**63 - 1)
TEXT = st.text(st.characters(codec='utf-8', exclude_characters='\0'), max_size=30)


PRIOR = 2_000_000_001


@st.composite
def any_weights(draw):
    count = draw(st.integers(1, 12) | st.integers(4000, 2**24))
    numbers = sorted(draw(st.sets(st.integers(0, count**2 - 1), max_size=30)))
    elements = st.floats(-1.0, 1.0, width=32)
    values = draw(hnp.arrays(np.float32, len(numbers), elements=elements))
    learned = LearnedWeights(
        count, draw(st.integers(0, 2**32 - 1)), np.array(numbers, np.int64), values
    )
    return WeightsUpdate(draw(st.integers(0, MAX_VERSION)), draw(WHOLE), learned)


def learned(count=4):
    """Every second synapse of a few neurons has learned."""
    synapses = np.arange(0, count * count, 2)
    values = np.linspace(-1.0, 1.0, len(synapses), dtype=np.float32)
    return LearnedWeights(count, PRIOR, synapses, values)


def message(count=4, version=7):
    return weight_messages.to_msg(WeightsUpdate(version, STAMP, learned(count)))


def figure(msg, name):
    return next(d for d in msg.layout.dim if d.label.startswith(f'{name}='))


@given(any_weights())
def test_weights_come_back_from_the_wire_bit_for_bit(weights):
    sent = serialize_message(weight_messages.to_msg(weights))
    back = weight_messages.from_msg(deserialize_message(sent, Float32MultiArray))
    assert back.version == weights.version
    assert back.segment_stamp_ns == weights.segment_stamp_ns
    assert back.learned.values.dtype == np.float32
    assert back.learned.same_as(weights.learned)


def test_a_message_is_as_long_as_what_was_learned():
    for count in (4, 10, 10_000):
        few = replace(learned(4), neurons=count)
        msg = weight_messages.to_msg(WeightsUpdate(7, STAMP, few))
        assert len(msg.data) == 3 * len(few)
    rows = np.array(message().data).reshape(-1, 3)
    assert rows[:3, :2].tolist() == [[0, 0], [0, 2], [1, 0]]
    assert np.array_equal(rows[:, 2].astype(np.float32), learned().values)


def test_received_weights_cannot_be_changed():
    back = weight_messages.from_msg(message()).learned
    for part in (back.synapses, back.values):
        with pytest.raises(ValueError, match='read-only'):
            part[0] = 0


@given(st.integers(0, 23), st.integers(0, 31))
def test_one_flipped_bit_is_noticed(index, bit):
    msg = message()
    raw = np.frombuffer(msg.data, np.uint32)
    raw[index] ^= np.uint32(1 << bit)
    with pytest.raises(MessageError):
        weight_messages.from_msg(msg)


@pytest.mark.parametrize(
    ('label', 'forged'),
    [('version', 8), ('segment_stamp_ns', 1), ('neurons', 5), ('prior_crc32', PRIOR + 1)],
)
def test_the_checksum_covers_the_identity(label, forged):
    msg = message()
    figure(msg, label).label = f'{label}={forged}'
    with pytest.raises(MessageError, match='crc32'):
        weight_messages.from_msg(msg)


@pytest.mark.parametrize('value', [np.nan, np.inf, -np.inf, 1.001, -2.0])
def test_impossible_weights_are_neither_sent_nor_taken(value):
    values = learned().values.copy()
    values[5] = value
    bad = WeightsUpdate(1, STAMP, replace(learned(), values=values))
    with pytest.raises(MessageError, match='must be'):
        weight_messages.to_msg(bad)
    msg = message()
    msg.data[3 * 5 + 2] = value
    with pytest.raises(MessageError, match='must be'):
        weight_messages.from_msg(msg)


@pytest.mark.parametrize('value', [np.nan, -1.0, 4.0, 0.5, 1e30, -0.0])
@pytest.mark.parametrize('column', [0, 1])
def test_rows_that_name_no_synapse_are_refused(value, column):
    msg = message()
    msg.data[column] = value
    with pytest.raises(MessageError, match='in row 0: must be one of 0 to 3'):
        weight_messages.from_msg(msg)


@pytest.mark.parametrize('synapses', [[4, 2, 6], [2, 2, 6], [-2, 2, 4], [0, 2, 16]])
def test_synapses_out_of_order_or_of_no_neuron_are_neither_sent_nor_taken(synapses):
    bad = LearnedWeights(4, PRIOR, np.array(synapses), np.zeros(3, np.float32))
    with pytest.raises(MessageError, match='must increase|must be one of 0 to 15'):
        weight_messages.to_msg(WeightsUpdate(1, STAMP, bad))


def test_rows_out_of_order_are_refused():
    msg = message()
    msg.data[:6] = msg.data[3:6] + msg.data[:3]
    with pytest.raises(MessageError, match='must increase'):
        weight_messages.from_msg(msg)


def test_half_a_message_is_refused():
    msg = message()
    msg.data = msg.data[:8]
    with pytest.raises(MessageError, match='data has 8 values: the layout says 24'):
        weight_messages.from_msg(msg)


def test_a_weight_for_each_synapse_is_needed():
    few = replace(learned(), values=np.zeros(3, np.float32))
    with pytest.raises(MessageError, match='must be one for each'):
        weight_messages.to_msg(WeightsUpdate(1, STAMP, few))


@pytest.mark.parametrize('count', [0, 2**24 + 1])
def test_numbers_of_neurons_that_cannot_be_named_are_refused(count):
    with pytest.raises(MessageError, match=f'neurons = {count}: must be 1 to 16777216'):
        weight_messages.to_msg(WeightsUpdate(1, STAMP, replace(learned(), neurons=count)))
    msg = message()
    figure(msg, 'neurons').label = f'neurons={count}'
    with pytest.raises(MessageError, match=f'neurons = {count}: must be 1 to 16777216'):
        weight_messages.from_msg(msg)


def test_layouts_of_other_people_are_refused_by_name():
    plain = Float32MultiArray(data=[0.0] * 4)
    with pytest.raises(MessageError, match='dims none: must be synapse, presynaptic'):
        weight_messages.from_msg(plain)
    swapped = message()
    swapped.layout.dim[0].label = 'rows'
    with pytest.raises(MessageError, match="dims 'rows', 'presynaptic, postsynaptic, weight'"):
        weight_messages.from_msg(swapped)
    wide = message()
    wide.layout.dim[0].size, wide.layout.dim[1].size = 6, 4
    with pytest.raises(MessageError, match='rows of 4 values: must be 3'):
        weight_messages.from_msg(wide)
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
    dim = figure(msg, 'version')
    dim.label = f'version={text}'
    with pytest.raises(MessageError):
        weight_messages.from_msg(msg)
    dim.label = text
    with pytest.raises(MessageError):
        weight_messages.from_msg(msg)


@pytest.mark.parametrize('neurons', [3, 5])
def test_weights_of_another_network_are_refused_before_they_are_copied(neurons, monkeypatch):
    msg = message(4)
    assert weight_messages.from_msg(msg, 4).version == 7
    monkeypatch.setattr(np, 'array', None)
    with pytest.raises(MessageError, match=f'weights of 4 neurons: must be of {neurons}'):
        weight_messages.from_msg(msg, neurons)


def test_huge_messages_are_refused_before_they_are_copied(monkeypatch):
    msg = message(4)
    monkeypatch.setattr(layout, 'MAX_VALUES', 23)
    monkeypatch.setattr(np, 'array', None)
    with pytest.raises(MessageError, match='data has 24 values: must be <= 23'):
        weight_messages.from_msg(msg)


def test_versions_leave_room_for_later_ones():
    last = message(version=MAX_VERSION)
    assert weight_messages.from_msg(last).version == MAX_VERSION
    for version in (-1, MAX_VERSION + 1):
        with pytest.raises(MessageError, match=f'version = {version}: must be'):
            message(version=version)
    figure(last, 'version').label = f'version={MAX_VERSION + 1}'
    with pytest.raises(MessageError, match='version = 1000000001: must be'):
        weight_messages.from_msg(last)


def test_every_dimension_of_the_layout_multiplies_up_to_the_data():
    msg = message(5)
    sizes = [dim.size for dim in msg.layout.dim]
    assert np.prod(sizes) == len(msg.data)
    assert msg.layout.dim[0].stride == 3 * 13
    assert msg.layout.dim[1].stride == 3


def test_the_checksum_is_that_of_the_stated_bytes():
    # CRC-32 of the bytes in their order, from the polynomial's definition.
    def crc(data):
        value = 0xFFFFFFFF
        for byte in data:
            value ^= byte
            for _ in range(8):
                value = (value >> 1) ^ (0xEDB88320 if value & 1 else 0)
        return value ^ 0xFFFFFFFF

    synapses, values = np.array([0, 3], np.int64), np.array([1.0, -0.5], np.float32)
    weights = WeightsUpdate(1, 2, LearnedWeights(4, 9, synapses, values))
    stated = struct.pack('<qqqqqqff', 1, 2, 4, 9, 0, 3, 1.0, -0.5)
    assert weights.checksum() == crc(stated)
