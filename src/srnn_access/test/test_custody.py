# SPDX-License-Identifier: Apache-2.0
from hypothesis import given
from hypothesis import strategies as st
import pytest

from srnn_access import Custody, Mark, Refusal
from srnn_access.custody import LONGEST_MOTION_S, WINDOW_S

HOLD = 0.5
WALL = 10**18
SECOND = 10**9
CODE = 'c' * 32


def sealed(source, sequence, signed_ns=WALL):
    return Mark(source, sequence, signed_ns, CODE)


class Listener:
    """A custody and the times at which it is told things."""

    def __init__(self):
        self.custody = Custody(HOLD)
        self.now = 100.0
        self.wall_ns = WALL

    def hears(self, mark, after=0.0, motion=0.0):
        self.now += after
        return self.custody.judge(mark, self.now, self.wall_ns, motion)


@pytest.fixture
def listener():
    return Listener()


def test_one_sender_in_order_is_accepted_gaps_included(listener):
    assert [listener.hears(Mark(7, n)) for n in (1, 2, 3, 9, 10**12)] == [None] * 5


@given(st.lists(st.integers(1, 30), max_size=40))
def test_of_one_sender_exactly_those_are_accepted_that_are_later_than_all_before(numbers):
    listener, newest = Listener(), 0
    for number in numbers:
        refusal = listener.hears(Mark(7, number))
        assert refusal == (None if number > newest else Refusal.REPLAYED)
        newest = max(newest, number)


@given(
    st.lists(
        st.tuples(
            st.none() | st.tuples(st.integers(1, 4), st.integers(1, 6)).map(lambda m: Mark(*m)),
            st.sampled_from([0.0, 0.1, HOLD, 3.0]),
        ),
        max_size=40,
    )
)
def test_whatever_comes_nothing_is_accepted_twice_and_nobody_comes_back(messages):
    listener, accepted = Listener(), []
    for mark, after in messages:
        if listener.hears(mark, after) is None and mark is not None:
            accepted.append(mark)
    assert accepted == sorted(set(accepted))


@given(
    st.lists(
        st.tuples(st.integers(0, 3), st.sampled_from([0.0, 0.1, 0.4, 0.6])),
        min_size=1, max_size=60,
    )
)  # fmt: skip
def test_whoever_is_in_charge_loses_it_only_by_silence(messages):
    """Sender 0 has no marks; every sender counts its messages rightly."""
    listener, counts = Listener(), [0] * 4
    owner, heard = None, 0.0
    for source, after in messages:
        counts[source] += 1
        mark = Mark(source, counts[source]) if source else None
        if listener.hears(mark, after) is not None:
            continue
        assert owner in (None, source) or listener.now - heard >= HOLD
        owner, heard = source, listener.now


def test_while_the_owner_is_heard_others_wait_and_then_the_newer_one_takes_over(listener):
    assert listener.hears(Mark(7, 1)) is None
    assert listener.hears(Mark(8, 1), 0.4) is Refusal.NOT_OWNER
    assert listener.hears(Mark(7, 2), 0.05) is None
    assert listener.hears(Mark(8, 2), 0.45) is Refusal.NOT_OWNER
    assert listener.hears(Mark(8, 3), 0.1) is None
    assert listener.hears(Mark(7, 3), 10.0) is Refusal.REPLAYED


def test_what_is_refused_keeps_nobody_in_charge(listener):
    assert listener.hears(Mark(7, 5)) is None
    for _ in range(10):
        assert listener.hears(Mark(7, 5), 0.04) is Refusal.REPLAYED
        assert listener.hears(Mark(8, 1)) is Refusal.NOT_OWNER
    assert listener.hears(Mark(8, 1), 0.11) is None


def test_a_message_without_a_mark_is_of_one_more_sender(listener):
    assert listener.hears(None) is None
    assert listener.hears(None, 0.3) is None
    assert listener.hears(Mark(7, 1), 0.3) is Refusal.NOT_OWNER
    assert listener.hears(Mark(7, 2), 0.3) is None
    assert listener.hears(None, 0.3) is Refusal.NOT_OWNER
    assert listener.hears(None, 0.3) is None
    assert listener.hears(Mark(7, 2), 9.0) is Refusal.REPLAYED
    assert listener.hears(Mark(7, 3)) is None


def test_a_sender_stays_in_charge_until_its_motion_is_over(listener):
    assert listener.hears(Mark(7, 1), motion=2.0) is None
    assert listener.hears(Mark(8, 1), 2.45) is Refusal.NOT_OWNER
    assert listener.hears(Mark(8, 2), 0.1) is None
    # A shorter motion does not end the longer one before it.
    assert listener.hears(Mark(8, 3), motion=2.0) is None
    assert listener.hears(Mark(8, 4), 0.1, motion=0.1) is None
    assert listener.hears(Mark(9, 1), 2.3) is Refusal.NOT_OWNER


@given(st.floats(allow_nan=False))
def test_no_message_keeps_a_topic_for_ever(motion):
    listener = Listener()
    assert listener.hears(None, motion=motion) is None
    assert listener.hears(Mark(7, 1), HOLD - 0.01) is Refusal.NOT_OWNER
    assert listener.hears(Mark(7, 2), LONGEST_MOTION_S + 0.02) is None


@pytest.mark.parametrize('age_s', [0.0, 4.9, -4.9])
def test_a_new_sender_is_believed_if_it_signed_just_now(listener, age_s):
    assert listener.hears(sealed(7, 1, WALL - round(age_s * SECOND))) is None


@pytest.mark.parametrize('age_s', [5.1, -5.1, 3600.0, -1e9, 1e9])
def test_a_recording_is_not_believed_by_a_listener_that_has_just_begun(listener, age_s):
    assert WINDOW_S == 5.0
    for number in range(1, 4):
        recorded = sealed(7, number, WALL - round(age_s * SECOND))
        assert listener.hears(recorded) is Refusal.OUTDATED
    assert listener.hears(sealed(8, 1)) is None


@given(st.lists(st.integers(-(2**62), 2**62), max_size=20))
def test_once_heard_a_sender_is_believed_whatever_the_system_clock_does(leaps_ns):
    listener = Listener()
    assert listener.hears(sealed(7, 1)) is None
    for number, leap_ns in enumerate(leaps_ns, 2):
        listener.wall_ns += leap_ns
        assert listener.hears(sealed(7, number), 100.0) is None


def test_a_successor_must_have_signed_just_now_too(listener):
    assert listener.hears(sealed(7, 1)) is None
    assert listener.hears(sealed(8, 1, WALL - 6 * SECOND), 1.0) is Refusal.OUTDATED
    assert listener.hears(sealed(7, 2)) is None
    assert listener.hears(sealed(8, 2), 1.0) is None
