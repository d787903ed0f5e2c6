# SPDX-License-Identifier: Apache-2.0
from hypothesis import given
from hypothesis import strategies as st
import pytest

from srnn_node.rate import RateKeeper

PERIODS = st.floats(1e-4, 10.0)
STARTS = st.floats(0.0, 1e6)


@given(PERIODS, STARTS, st.integers(1, 500))
def test_ticks_taken_in_time_do_not_drift(period, start, count):
    keeper = RateKeeper(period, start)
    for n in range(count):
        assert keeper.due == start + n * period
        assert keeper.take(keeper.due)
    assert (keeper.taken, keeper.overruns, keeper.skipped) == (count, 0, 0)


@given(PERIODS, STARTS, st.lists(st.floats(0.0, 20.0), max_size=60), st.integers(1, 5))
def test_after_any_delays_the_grid_stays_and_every_tick_is_taken_or_skipped(
    period, start, delays, catch_up
):
    keeper = RateKeeper(period, start, catch_up)
    now = start
    for delay in delays:
        now += delay * period
        burst = 0
        while keeper.take(now):
            burst += 1
        assert burst <= catch_up
        assert keeper.due > now
        assert keeper.due == start + (keeper.taken + keeper.skipped) * period


@given(PERIODS, STARTS, st.floats(-5.0, 5.0))
def test_a_tick_is_due_exactly_when_there_is_nothing_to_wait_for(period, start, offset):
    keeper = RateKeeper(period, start)
    now = start + offset * period
    wait = keeper.seconds_to_tick(now)
    assert wait >= 0.0
    assert keeper.take(now) == (wait == 0.0)


def test_a_late_tick_does_not_move_the_next_one():
    keeper = RateKeeper(1.0, 10.0)
    assert keeper.take(10.75)
    assert keeper.overruns == 0
    assert keeper.seconds_to_tick(10.75) == 0.25


def test_a_long_gap_is_made_up_for_within_bounds():
    keeper = RateKeeper(1.0, 0.0, catch_up=2)
    taken = 0
    while keeper.take(9.5):
        taken += 1
    assert (taken, keeper.skipped, keeper.due) == (2, 8, 10.0)
    assert keeper.overruns == 1


@pytest.mark.parametrize('period', [0.0, -1.0, float('nan')])
def test_a_period_must_be_positive(period):
    with pytest.raises(ValueError, match=r'period = .* s: must be > 0'):
        RateKeeper(period, 0.0)


def test_at_least_one_late_tick_must_be_allowed():
    with pytest.raises(ValueError, match='catch_up = 0: must be >= 1'):
        RateKeeper(1.0, 0.0, catch_up=0)
