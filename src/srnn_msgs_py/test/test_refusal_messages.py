# SPDX-License-Identifier: Apache-2.0
from array import array

from hypothesis import given
from hypothesis import strategies as st
import pytest

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.ros import refusal
from srnn_msgs_py.weights import MAX_VERSION

TEXT = st.text(st.characters(codec='utf-8', exclude_characters='\0'), max_size=50)


def test_a_refusal_comes_back_from_the_wire(wire):
    value = WeightsRefusal(7, 5, 'no valid plan in 10 tries, reason=none')
    assert refusal.from_msg(wire(refusal.to_msg(value))) == value


def test_a_long_reason_is_cut_not_refused():
    sent = refusal.to_msg(WeightsRefusal(7, 5, 'x' * 5000))
    assert refusal.from_msg(sent).reason == 'x' * refusal.MAX_REASON


@pytest.mark.parametrize(
    'versions',
    [(5, 5), (5, 7), (5, -1), (-1, -2), (MAX_VERSION + 1, 0), (), (7,), (7, 5, 3)],
)
def test_impossible_versions_are_refused(versions):
    msg = refusal.to_msg(WeightsRefusal(7, 5, ''))
    msg.data = array('q', versions)
    msg.layout.dim[0].size = len(versions)
    with pytest.raises(MessageError, match='must be'):
        refusal.from_msg(msg)


def test_half_a_message_is_refused():
    msg = refusal.to_msg(WeightsRefusal(7, 5, ''))
    msg.data = msg.data[:1]
    with pytest.raises(MessageError, match='data has 1 values: the layout says 2'):
        refusal.from_msg(msg)


@given(TEXT.filter(lambda text: not text.startswith('reason=')))
def test_a_message_without_a_reason_is_refused(text):
    msg = refusal.to_msg(WeightsRefusal(7, 5, 'dead'))
    msg.layout.dim[1].label = text
    with pytest.raises(MessageError):
        refusal.from_msg(msg)


def test_an_endless_reason_of_somebody_else_is_refused():
    msg = refusal.to_msg(WeightsRefusal(7, 5, 'dead'))
    msg.layout.dim[1].label = 'reason=' + 'x' * (refusal.MAX_REASON + 1)
    with pytest.raises(MessageError, match='must be <='):
        refusal.from_msg(msg)
