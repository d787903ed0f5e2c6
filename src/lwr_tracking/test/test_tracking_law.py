# SPDX-License-Identifier: Apache-2.0
"""Laws of the joint commands."""

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_description import POSITION_MAX, VELOCITY_MAX, Kinematics, Mount
from lwr_tracking.core.parameters import LawParameters, LimitParameters
from lwr_tracking.core.spd_solve import solve_spd3
from lwr_tracking.core.tracking_law import TrackingLaw

DT = 0.004
KINEMATICS = Kinematics(Mount())
LAW = LawParameters()
LIMITS = LimitParameters()


def law_at(x=0.0, y=0.0, z=0.0):
    law = TrackingLaw(LAW, LIMITS, KINEMATICS)
    law.start(KINEMATICS.inverse((x, y, z)))
    return law


@given(st.integers(0, 2**32 - 1))
def test_the_small_solver_solves(seed):
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(3, 5))
    matrix, x = root @ root.T + 0.01 * np.eye(3), rng.normal(size=3)
    np.testing.assert_allclose(solve_spd3(matrix, matrix @ x), x, atol=1e-7)


@pytest.mark.parametrize('speed', [0.1, 0.25])
def test_the_commanded_tip_follows_a_circle_in_place_and_time(speed):
    radius = 0.2
    law = law_at(radius)
    for time in np.arange(DT, 2.0 * np.pi * radius / speed, DT):
        angle = speed * time / radius
        target = radius * np.array((np.cos(angle), np.sin(angle), 0.0))
        before = law.command
        after = law.step(target, DT)
        assert np.linalg.norm(KINEMATICS.tip(after) - target) < 5e-5
        assert np.all(np.abs(after - before) <= LIMITS.velocity_share * VELOCITY_MAX * DT)


def test_laps_do_not_drift_away_from_the_posture_of_home():
    law, radius = law_at(0.2), 0.2
    laps = []
    for angle in np.arange(0.0, 6.0 * np.pi, 0.004):
        law.step(radius * np.array((np.cos(angle), np.sin(angle), 0.0)), 2.0 * DT)
        laps.append(law.command)
    per_lap = int(2.0 * np.pi / 0.004)
    assert np.abs(laps[-1] - laps[-1 - per_lap]).max() < 0.01


def test_a_far_target_is_approached_at_the_permitted_speed_only():
    law = law_at()
    tip = KINEMATICS.tip(law.command)
    for _ in range(100):
        law.step(np.array((0.25, 0.1, 0.0)), DT)
        moved = KINEMATICS.tip(law.command)
        assert np.linalg.norm(moved - tip) <= LAW.tip_speed * DT * 1.01
        tip = moved
    law_end = np.linalg.norm(KINEMATICS.tip(law.command) - (0.25, 0.1, 0.0))
    assert law_end < 0.27 - 0.9 * LAW.tip_speed * 0.4 + 0.01


@settings(max_examples=20)
@given(st.tuples(*[st.floats(-3.0, 3.0)] * 3), st.integers(0, 2**32 - 1))
def test_limits_hold_whatever_the_target(target, seed):
    rng = np.random.default_rng(seed)
    law = TrackingLaw(LAW, LIMITS, KINEMATICS)
    law.start(rng.uniform(-0.98, 0.98, 7) * POSITION_MAX)
    bound = np.maximum(POSITION_MAX - LIMITS.position_margin, np.abs(law.command))
    for _ in range(150):
        before = law.command
        law.step(np.array(target), DT)
        assert np.isfinite(law.command).all()
        assert np.all(np.abs(law.command) <= bound)
        step = np.abs(law.command - before) / DT
        assert np.all(step <= LIMITS.velocity_share * VELOCITY_MAX * (1 + 1e-9))


def test_no_time_no_motion():
    law = law_at()
    before = law.command.copy()
    np.testing.assert_array_equal(law.step(np.array((0.1, 0.0, 0.0)), 0.0), before)


def test_the_correction_is_an_integral_with_a_bound():
    law = law_at()
    error = (0.001, -0.002, 0.0)
    for _ in range(10):
        law.correct(error, DT)
    np.testing.assert_allclose(law.correction, LAW.integral_gain * 10 * DT * np.array(error))
    for _ in range(100_000):
        law.correct(error, DT)
    np.testing.assert_allclose(law.correction, (0.008, -0.008, 0.0))


def test_following_the_arm_is_as_fast_as_the_joints_may_be():
    law = law_at()
    away = law.command + np.array((0.5, 0.0, 0.0, -0.5, 0.0, 0.001, 0.0))
    start = law.command
    law.follow(away, DT)
    reach = LIMITS.velocity_share * VELOCITY_MAX * DT
    np.testing.assert_allclose(law.command - start, np.clip(away - start, -reach, reach))
    for _ in range(100):
        law.follow(away, DT)
    np.testing.assert_allclose(law.command, away)
