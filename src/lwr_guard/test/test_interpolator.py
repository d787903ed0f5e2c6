# SPDX-License-Identifier: Apache-2.0
"""The interpolator is a critically damped filter: exact, smooth, without overshoot."""

import numpy as np
import pytest

from lwr_guard.interpolator import Interpolator

TAU = 0.004
TICK = 0.001


def run(filter_, commands):
    """Feed one command (or None) per tick; return positions and velocities of joint 0."""
    record = []
    for command in commands:
        if command is not None:
            filter_.command(np.full(7, command))
        filter_.step()
        record.append((filter_.position[0], filter_.velocity[0]))
    return np.array(record).T


def test_rests_at_its_start():
    position, velocity = run(Interpolator(np.full(7, 0.3), TAU, TICK), [None] * 20)
    np.testing.assert_allclose(position, 0.3, rtol=0, atol=1e-15)
    np.testing.assert_allclose(velocity, 0.0, rtol=0, atol=1e-12)


def test_step_response_is_the_closed_form():
    position, velocity = run(Interpolator(np.zeros(7), TAU, TICK), [1.0] + [None] * 39)
    s = np.arange(1, 41) * TICK / TAU
    np.testing.assert_allclose(position, 1 - (1 + s) * np.exp(-s), atol=1e-12)
    np.testing.assert_allclose(velocity, s * np.exp(-s) / TAU, atol=1e-9)
    assert (np.diff(position) > 0).all()
    assert position[-1] < 1.0


def test_ramp_is_followed_two_time_constants_late():
    ticks = np.arange(1, 200)
    position, velocity = run(Interpolator(np.zeros(7), TAU, TICK), 0.5 * ticks * TICK)
    assert position[-1] == pytest.approx(0.5 * (ticks[-1] * TICK - 2 * TAU), abs=0.5 * TICK)
    assert velocity[-1] == pytest.approx(0.5, rel=0.01)


def test_velocity_stays_smooth_under_jittered_commands():
    """A 250 Hz ramp, each command up to 1 ms early or late: velocity within 30 %."""
    rng = np.random.default_rng(4)
    commands = [None] * 1000
    for k in range(249):
        due = 4 * k + 1 + rng.integers(-1, 2)
        commands[max(due, 0)] = 0.3 * 4 * k * TICK
    _, velocity = run(Interpolator(np.zeros(7), TAU, TICK), commands)
    assert np.abs(velocity[50:980] - 0.3).max() < 0.3 * 0.3


def test_silence_brings_it_to_rest_at_the_last_command():
    ramp = [0.001 * k for k in range(100)] + [None] * 100
    position, velocity = run(Interpolator(np.zeros(7), TAU, TICK), ramp)
    assert position[-1] == pytest.approx(0.099, abs=1e-9)
    assert velocity[-1] == pytest.approx(0.0, abs=1e-6)
