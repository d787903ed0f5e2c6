# SPDX-License-Identifier: Apache-2.0
"""A newcomer waits for those who were there before, and not for ever."""

import math

from hypothesis import given
from hypothesis import strategies as st

from srnn_node.settling import FOUND_S, LONGEST_S, QUIET_S, Settling

STEP_S = 1 / 64
"""Times that are sums of it are exact [s]."""


def waited(counts, age=60.0):
    """Return after how many steps it is settled, if the last count stays."""
    settling = Settling(-age, 0.0)
    step = 0
    while not settling.done(counts[min(step, len(counts) - 1)], STEP_S * step):
        step += 1
    return step


def steps(seconds):
    return math.ceil(seconds / STEP_S)


def test_one_that_was_long_in_coming_has_found_the_others_and_waits_for_their_topics():
    assert waited([5]) == steps(QUIET_S)


def test_one_that_has_just_come_waits_until_it_must_have_found_the_others():
    assert waited([0], age=0.0) == steps(FOUND_S)
    assert waited([0, 1, 2], age=0.25) == steps(FOUND_S - 0.25)


def test_it_waits_from_the_last_one_found_on():
    assert waited([0, 1, 1, 1, 4]) == 4 + steps(QUIET_S)


def test_who_leaves_is_not_waited_for():
    assert waited([3, 3, 2, 1, 0]) == steps(QUIET_S)


def test_who_comes_after_another_has_left_is_waited_for():
    assert waited([3, 3, 2, 3]) == 3 + steps(QUIET_S)


@given(st.lists(st.integers(0, 50), min_size=1, max_size=200), st.floats(0.0, 60.0))
def test_it_never_waits_longer_than_told(counts, age):
    assert steps(QUIET_S) <= waited(counts, age) <= steps(LONGEST_S)
