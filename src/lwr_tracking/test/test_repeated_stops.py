# SPDX-License-Identifier: Apache-2.0
"""Stops count together when they are near in time and place, and the tip stayed there."""

import numpy as np
import pytest

from lwr_tracking.core.parameters import ContactParameters
from lwr_tracking.core.repeated_stops import RepeatedStops

PARAMETERS = ContactParameters(repeats=3, window=2.0, place=0.01)
HERE = np.array((0.1, -0.2, 0.001))
ALONG = np.array((1.0, 0.0, 0.0))


def stops(times, between=lambda stops: None):
    repeated, found = RepeatedStops(PARAMETERS), []
    for time in times:
        found.append(repeated.stop(time, HERE))
        between(repeated)
    return found


def test_the_fourth_within_the_window_is_one_too_many():
    assert stops([0.0, 0.5, 1.0, 2.0]) == [False, False, False, True]
    assert stops([0.0, 0.5, 1.0, 2.01, 2.2]) == [False, False, False, False, True]


def test_slow_ones_may_go_on_for_ever():
    assert not any(stops(np.arange(0.0, 100.0, 0.67)))


@pytest.mark.parametrize(('away', 'one_too_many'), [(0.009, True), (0.011, False)])
def test_they_are_forgotten_once_the_tip_has_got_away(away, one_too_many):
    def leave_and_return(repeated):
        repeated.moved(HERE + away * ALONG)
        repeated.moved(HERE)

    assert any(stops([0.0, 0.1, 0.2, 0.3, 0.4], leave_and_return)) == one_too_many


def test_a_creeping_place_is_left_in_the_end():
    repeated = RepeatedStops(PARAMETERS)
    for k in range(50):
        place = HERE + 0.004 * k * ALONG
        repeated.moved(place)
        assert not repeated.stop(0.1 * k, place)


def test_it_can_be_told_to_forget():
    assert not any(stops([0.0, 0.1, 0.2, 0.3, 0.4], RepeatedStops.forget))
