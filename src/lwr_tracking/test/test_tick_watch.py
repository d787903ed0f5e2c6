# SPDX-License-Identifier: Apache-2.0
"""One late tick is nothing; several in a row are an overload, until they have long not been."""

from hypothesis import given
from hypothesis import strategies as st

from lwr_tracking.core.tick_watch import (
    GLIDE,
    HELD_AFTER,
    MANY,
    RECOVERED,
    SLOW,
    TOLERATED,
    TickWatch,
)

PERIOD = 0.004
LATE, IN_TIME = 2.0 * PERIOD, 1.2 * PERIOD


def test_the_fifth_late_tick_in_a_row_is_an_overload():
    watch = TickWatch(PERIOD)
    for _ in range(3):
        assert not any(watch.tick(LATE) for _ in range(TOLERATED))
        assert not watch.tick(IN_TIME)
    assert [watch.tick(LATE) for _ in range(TOLERATED + 1)] == [False] * TOLERATED + [True]
    assert watch.late == 4 * TOLERATED + 1


def test_it_ends_after_many_ticks_without_five_late_in_a_row():
    for recovery in ([IN_TIME], [LATE, IN_TIME], [IN_TIME] * 3 + [LATE] * TOLERATED):
        watch = TickWatch(PERIOD)
        for _ in range(TOLERATED + 1):
            watch.tick(LATE)
        assert watch.tick(IN_TIME)
        ticks = (recovery * RECOVERED)[: RECOVERED - 1]
        assert [watch.tick(elapsed) for elapsed in ticks] == [True] * (RECOVERED - 2) + [False]
        assert not watch.tick(IN_TIME)


def test_it_lasts_while_five_in_a_row_are_late_now_and_then():
    watch = TickWatch(PERIOD)
    for _ in range(TOLERATED + 1):
        watch.tick(LATE)
    bursts = ([IN_TIME] * (RECOVERED - TOLERATED - 1) + [LATE] * (TOLERATED + 1)) * 10
    assert all(watch.tick(elapsed) for elapsed in bursts)


@given(st.lists(st.booleans(), max_size=300))
def test_without_five_in_a_row_there_is_no_overload(late):
    watch = TickWatch(PERIOD)
    five = 'T' * (TOLERATED + 1) in ''.join('T' if value else 'F' for value in late)
    seen = [watch.tick(LATE if value else IN_TIME) for value in late]
    assert any(seen) == five
    assert watch.late == sum(late)


def test_where_many_are_late_the_arm_goes_slower_and_nowhere_else():
    watch = TickWatch(PERIOD)
    few = ([LATE] + [IN_TIME] * (RECOVERED // MANY - 1)) * 40
    assert all(watch.tick(elapsed) is False and watch.pace == 1.0 for elapsed in few)
    for _ in range(200):
        watch.tick(LATE)
        watch.tick(IN_TIME)
    assert watch.pace == SLOW
    for _ in range(200):
        watch.tick(IN_TIME)
    assert watch.pace == 1.0


@given(st.lists(st.booleans(), max_size=400))
def test_the_pace_glides_between_its_bounds(late):
    watch, before = TickWatch(PERIOD), 1.0
    for value in late:
        watch.tick(LATE if value else IN_TIME)
        assert SLOW <= watch.pace <= 1.0
        assert abs(watch.pace - before) <= GLIDE + 1e-12
        before = watch.pace


def test_an_arm_that_was_held_sets_off_slowly():
    watch = TickWatch(PERIOD)
    watch.tick(HELD_AFTER)
    assert watch.pace == 1.0
    watch.tick(1.01 * HELD_AFTER)
    assert watch.pace == SLOW
    paces = [watch.pace for _ in range(round((1.0 - SLOW) / GLIDE)) if not watch.tick(IN_TIME)]
    assert paces == sorted(paces)
    assert SLOW < paces[0] < paces[-1] == 1.0
