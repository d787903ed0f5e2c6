# SPDX-License-Identifier: Apache-2.0
"""Lost messages are counted, whoever joins or is started anew."""

from hypothesis import given
from hypothesis import strategies as st

from srnn_bringup.sequence_gaps import SequenceGaps


def heard(numbers):
    gaps = SequenceGaps()
    for number in numbers:
        gaps.take(number)
    return gaps.lost


@given(st.integers(1, 10**6), st.integers(0, 300))
def test_nothing_is_lost_of_what_came_in_a_row_from_anywhere(first, count):
    assert heard(range(first, first + count)) == 0


@given(st.sets(st.integers(2, 400)))
def test_every_gap_counts(missing):
    last = 401
    assert heard(n for n in range(1, last + 1) if n not in missing) == len(missing)


@given(st.lists(st.integers(1, 50), min_size=1, max_size=10))
def test_a_successor_begins_anew(lives):
    assert heard(number for count in lives for number in range(1, count + 1)) == 0


@given(st.integers(1, 10**6), st.integers(1, 50))
def test_the_first_words_of_a_successor_count(last, first):
    assert heard([last, min(first, last)]) == min(first, last) - 1


def test_last_words_of_a_predecessor_may_come_late():
    assert heard([1, 2, 3, 1, 4, 2, 3, 5]) == 0
