# SPDX-License-Identifier: Apache-2.0
"""What a sender marks and seals, and what a listener makes of it, without middleware."""

from hypothesis import given
from hypothesis import strategies as st
import pytest
from sample_messages import OWNED, change, changes, over_the_wire, sample_message

from srnn_access import Key, Refusal, Source
from srnn_msgs_py.ros.mark_carrier import mark_carrier
from srnn_msgs_py.topics import TOPICS, topic
from srnn_node.inlet import Inlet
from srnn_node.outlet import Outlet

KEY, OTHER = Key(b'k' * 32), Key(b'o' * 32)
WALL = 1_790_000_000_000_000_000
every_owned = pytest.mark.parametrize('row', OWNED, ids=lambda row: row.name)


def sent(row, key=KEY, name='/topic', wall_ns=WALL, source=None, count=1):
    """Return the last of some messages as it arrives."""
    outlet = Outlet(row, name, source or Source(), key)
    for _ in range(count):
        msg = sample_message(row.name)
        outlet.mark(msg, wall_ns)
    return over_the_wire(msg)


def judged(row, msg, key=KEY, name='/topic', wall_ns=WALL):
    return Inlet(row, name, key).judge(msg, 100.0, wall_ns)


@every_owned
@pytest.mark.parametrize('key', [None, KEY])
def test_what_was_sent_is_accepted_once_and_is_as_it_was(row, key):
    inlet, msg = Inlet(row, '/topic', key), sent(row, key)
    again = over_the_wire(msg)
    assert inlet.judge(msg, 100.0, WALL) is None
    assert (msg == sample_message(row.name)) == bool(key or row.ownership.always)
    if key or row.ownership.always:
        assert inlet.judge(again, 100.1, WALL) is Refusal.REPLAYED
        assert inlet.refused == {Refusal.REPLAYED: 1}
        assert (inlet.last, inlet.last_time) == (Refusal.REPLAYED, 100.1)


@every_owned
def test_a_message_stays_as_it_was_when_it_has_been_sent(row):
    msg = sample_message(row.name)
    outlet = Outlet(row, '/topic', Source(), KEY)
    for _ in range(2):
        outlet.mark(msg, WALL)
        assert msg != sample_message(row.name)
        outlet.unmark(msg)
        assert msg == sample_message(row.name)


@every_owned
def test_no_bit_of_a_sealed_message_can_be_turned_over_unseen(row):
    """Every bit of every field, the mark included; and no list can be longer or shorter."""
    count = changes(sent(row))
    assert count > 300
    # A message of many numbers is made of the same fields again and again.
    for index in range(0, count, 1 + count // 1000):
        msg = sent(row)
        change(msg, index)
        assert judged(row, msg) in (Refusal.ALTERED, Refusal.UNSIGNED)


@given(st.data())
def test_no_two_bits_of_a_sealed_message_can_be_turned_over_unseen(data):
    row = data.draw(st.sampled_from(OWNED))
    msg = sent(row)
    before = repr(msg)
    for _ in range(2):
        change(msg, data.draw(st.integers(0, changes(msg) - 1)))
    same = repr(msg) == before
    assert (judged(row, msg) is None) == same


@every_owned
@pytest.mark.parametrize('text', ['', '#', 'x', '0123456789abcdef', '0123456789abcdef.1' + '\n'])
@pytest.mark.parametrize('key', [None, KEY])
def test_a_mark_that_cannot_be_read_is_refused(row, text, key):
    msg = sample_message(row.name)
    mark_carrier(type(msg)).put(msg, text)
    guarded = key or row.ownership.always
    assert judged(row, over_the_wire(msg), key) == (Refusal.ALTERED if guarded else None)


@given(st.text(st.characters(codec='utf-8', exclude_characters='\0'), max_size=60))
def test_no_text_in_the_place_of_a_mark_is_believed(text):
    for row in OWNED:
        msg = sample_message(row.name)
        mark_carrier(type(msg)).put(msg, text)
        assert judged(row, msg) in (Refusal.ALTERED, Refusal.UNSIGNED)


@every_owned
def test_with_a_key_messages_without_a_code_are_refused(row):
    assert judged(row, sample_message(row.name)) is Refusal.UNSIGNED
    # Of a topic that is only marked with a key there is no such sender.
    assert judged(row, sent(row, key=None)) is Refusal.UNSIGNED


@every_owned
def test_a_seal_is_good_for_one_key_and_one_topic(row):
    assert judged(row, sent(row, OTHER)) is Refusal.ALTERED
    assert judged(row, sent(row, name='/other/topic')) is Refusal.ALTERED
    assert judged(row, sent(row), OTHER) is Refusal.ALTERED


@every_owned
def test_a_recording_does_not_deceive_a_listener_that_has_just_begun(row):
    assert judged(row, sent(row), wall_ns=WALL + 6 * 10**9) is Refusal.OUTDATED


@every_owned
def test_without_a_key_marks_are_believed_and_nobody_needs_one(row):
    for msg in (sample_message(row.name), sent(row, key=None), sent(row, OTHER)):
        assert judged(row, msg, key=None) is None


@every_owned
def test_the_first_of_two_senders_keeps_the_topic(row):
    first, second = Source(), Source()
    inlet, kept = Inlet(row, '/topic', KEY), row.ownership.hold
    assert inlet.judge(sent(row, source=first), 100.0, WALL) is None
    for n in range(1, 4):
        other = sent(row, source=second, wall_ns=WALL + n, count=n)
        now = 100.0 + 0.9 * kept * n
        assert inlet.judge(other, now, WALL) is Refusal.NOT_OWNER
        assert inlet.judge(sent(row, source=first, count=n + 1), now, WALL) is None


def test_a_planner_keeps_the_arm_until_its_motion_is_over():
    row, first, second = topic('segment'), Source(), Source()
    inlet, duration = Inlet(row, '/topic', None), 0.3
    assert inlet.judge(sent(row, None, source=first), 100.0, WALL) is None
    end = 100.0 + duration + row.ownership.hold
    early, late = (sent(row, None, source=second, wall_ns=WALL + 1, count=n) for n in (1, 2))
    assert inlet.judge(early, end - 0.01, WALL) is Refusal.NOT_OWNER
    assert inlet.judge(late, end + 0.01, WALL) is None


def test_a_trajectory_without_points_is_no_motion():
    msg = sample_message('segment')
    msg.points.clear()
    assert judged(topic('segment'), msg, None) is None


@pytest.mark.parametrize('row', [r for r in TOPICS if not r.ownership], ids=lambda row: row.name)
def test_topics_of_people_and_tools_are_open_even_with_a_key(row):
    assert judged(row, object()) is None
