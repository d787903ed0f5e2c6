# SPDX-License-Identifier: Apache-2.0
"""Laws of the delay line."""

from hypothesis import given
from hypothesis import strategies as st
import pytest

from lwr_tracking.core.delay_line import DelayLine

DELAY = 0.012


@given(st.lists(st.floats(0.0, 0.02), min_size=1, max_size=60))
def test_a_ramp_comes_out_later_by_the_delay(steps):
    line, time = DelayLine(DELAY), 0.0
    line.fill((0.0, 0.0, 0.0, 0.0))
    for step in steps:
        time += step
        x, y, z, clock = line.push(step, (time, -time, 2.0 * time, time))
        late = max(time - DELAY, 0.0)
        assert (x, y, z, clock) == pytest.approx((late, -late, 2.0 * late, late), abs=1e-12)


def test_what_stands_still_comes_out_exactly():
    line = DelayLine(DELAY)
    value = (0.1, 0.2, 0.3, 12345.678)
    line.fill(value)
    assert all(line.push(0.0037, value) == value for _ in range(20))


def test_filling_forgets_the_past():
    line = DelayLine(DELAY)
    line.fill((0.0, 0.0, 0.0, 0.0))
    line.push(0.004, (1.0, 1.0, 1.0, 1.0))
    line.fill((5.0, 5.0, 5.0, 5.0))
    assert line.push(0.004, (5.0, 5.0, 5.0, 5.0)) == (5.0, 5.0, 5.0, 5.0)
