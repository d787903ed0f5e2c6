# SPDX-License-Identifier: Apache-2.0
"""Commands that cease are noticed in time, and the share of the missing ones is counted."""

from hypothesis import given
from hypothesis import strategies as st
import pytest

from lwr_guard import CommandWatch, GuardParameters
from lwr_guard.command_watch import WINDOW

PARAMETERS = GuardParameters()


def run(came):
    """Return a watch after cycles that brought a command or not, and when it held."""
    watch, held = CommandWatch(PARAMETERS), []
    for k, there in enumerate(came):
        now = k * PARAMETERS.period
        if there:
            watch.good(now)
        held.append(watch.cycle(now))
    return watch, held


def test_nothing_is_missed_before_the_first_command():
    watch, held = run([False] * 50)
    assert not any(held)
    assert (watch.holds, watch.answered) == (0, 1.0)


def test_it_holds_20_ms_after_the_last_command_until_the_next():
    watch, held = run([True] * 10 + [False] * 20 + [True] * 3 + [False] * 20)
    assert held.index(True) - 9 == round(0.02 / PARAMETERS.period)
    assert not any(held[30:33])
    assert watch.holds == 2
    assert watch.holding


@given(st.lists(st.booleans(), min_size=1, max_size=3 * WINDOW))
def test_the_share_is_that_of_the_last_hundred_cycles(came):
    watch, _ = run([True, *came])
    last = [True, *came][-WINDOW:]
    assert watch.answered == pytest.approx(sum(last) / len(last))


@given(st.lists(st.booleans(), max_size=200))
def test_it_holds_exactly_while_the_last_command_is_too_old(came):
    _, held = run([True, *came])
    age = 0.0
    for there, holds in zip(came, held[1:], strict=True):
        age = 0.0 if there else age + PARAMETERS.period
        assert holds == (age > PARAMETERS.silence - 1e-9)
