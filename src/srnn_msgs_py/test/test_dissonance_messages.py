# SPDX-License-Identifier: Apache-2.0
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Float32MultiArray

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros import dissonance

STAMP = 1_795_000_000_123_456_789
FLOATS = st.floats(allow_nan=False, allow_infinity=False)
VECTOR = hnp.arrays(np.float32, st.integers(0, 50), elements=st.floats(0.0, 1.0, width=32))


def message():
    value = Dissonance(
        STAMP, 'local', True, 3, 0.3, np.ones(4, np.float32), np.zeros(9, np.float32), 4.5
    )
    return dissonance.to_msg(value)


@st.composite
def any_dissonance(draw):
    return Dissonance(
        segment_stamp_ns=draw(st.integers(0, 2**63 - 1)),
        signal=draw(st.sampled_from(['local', 'global', 'a=b'])),
        updated=draw(st.booleans()),
        weights_version=draw(st.integers(0, 10**6)),
        peak=draw(FLOATS),
        global_alpha=draw(VECTOR),
        neuron_peak=draw(VECTOR),
        update_ms=draw(FLOATS),
    )


@given(any_dissonance())
def test_dissonance_comes_back_from_the_wire_bit_for_bit(value):
    sent = serialize_message(dissonance.to_msg(value))
    back = dissonance.from_msg(deserialize_message(sent, Float32MultiArray))
    for name in ('segment_stamp_ns', 'signal', 'updated', 'weights_version', 'peak', 'update_ms'):
        assert getattr(back, name) == getattr(value, name)
        assert type(getattr(back, name)) is type(getattr(value, name))
    np.testing.assert_array_equal(back.global_alpha, value.global_alpha)
    np.testing.assert_array_equal(back.neuron_peak, value.neuron_peak)


@pytest.mark.parametrize(
    ('figure', 'text', 'complaint'),
    [
        ('steps', '14', 'steps = 14: must be <= 13'),
        ('steps', '-1', 'must be a whole number'),
        ('updated', 'yes', 'must be a whole number'),
        ('peak', 'nan', 'must be a finite number'),
        ('update_ms', 'fast', 'must be a finite number'),
        ('weights_version', '9' * 30, 'must be a whole number'),
    ],
)
def test_wrong_figures_are_refused_by_name(figure, text, complaint):
    msg = message()
    dim = next(d for d in msg.layout.dim if d.label.startswith(f'{figure}='))
    dim.label = f'{figure}={text}'
    with pytest.raises(MessageError, match=complaint):
        dissonance.from_msg(msg)


def test_a_missing_figure_is_named_with_those_that_came():
    msg = message()
    msg.layout.dim = [d for d in msg.layout.dim if not d.label.startswith('signal')]
    with pytest.raises(MessageError, match='layout lacks signal=…; it has steps, '):
        dissonance.from_msg(msg)


def test_dissonance_must_be_finite():
    msg = message()
    msg.data[5] = float('inf')
    with pytest.raises(MessageError, match=r'data\[5\] = inf: must be finite'):
        dissonance.from_msg(msg)
