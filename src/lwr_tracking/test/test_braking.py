# SPDX-License-Identifier: Apache-2.0
"""The room that a soft stop needs."""

import numpy as np
import pytest
from segments import chain, line

from lwr_tracking.core.braking import braking_room
from lwr_tracking.core.quintic_path import QuinticPath

LIMIT = 1.5


def path_of(segment):
    return QuinticPath(
        segment.times, segment.positions, segment.velocities, segment.accelerations
    )


@pytest.mark.parametrize('speed', [0.05, 0.1, 0.2, 0.25])
def test_at_constant_speed_it_is_the_closed_form(speed):
    path = path_of(line((0.0, 0.0), (0.2, 0.0), speed, stop=False))
    assert braking_room(path, LIMIT) == pytest.approx(speed / (2.0 * LIMIT), rel=1e-3)


def test_a_path_that_ends_at_rest_needs_none():
    assert braking_room(path_of(line((0.0, 0.0), (0.1, 0.0), 0.1)), LIMIT) == 0.0


def test_a_path_too_short_for_its_speed_has_none():
    times = np.array([0.0, 0.02])
    velocity = np.full((2, 2), 0.15)
    path = QuinticPath(times, times[:, None] * velocity, velocity, np.zeros((2, 2)))
    assert braking_room(path, LIMIT) == np.inf


def test_the_room_keeps_the_deceleration_on_a_curve_below_the_limit():
    for segment in chain([(0, 0), (0.1, 0.1), (0.2, 0), (0.1, -0.1), (0, 0)], 0.2, stop=False):
        path = path_of(segment)
        room = braking_room(path, LIMIT)
        time = np.linspace(0.0, 2.0 * room, 400)
        rate = 1.0 - time / (2.0 * room)
        _, v, _ = path.evaluate(path.duration - room * rate**2)
        speed = rate * np.hypot(v[:, 0], v[:, 1])
        assert -np.diff(speed).min() / (time[1] - time[0]) <= 1.02 * LIMIT
