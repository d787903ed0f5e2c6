# SPDX-License-Identifier: Apache-2.0
"""The tracker and measurements that are not true, on an arm without physics."""

import dataclasses

import numpy as np
from perfect_arm import PERIOD, PROMPT, PerfectArm, codes, started
import pytest
from segments import line

from lwr_tracking.core.failsafe import Condition
from srnn_msgs_py.result import ResultCode


@pytest.fixture
def arm():
    arm = PerfectArm(PROMPT)
    arm.tick()
    return arm


def test_a_measurement_that_is_not_finite_freezes_and_latches(arm):
    started(arm)
    good = arm.q
    for field in ('position', 'external_torque'):
        bad = dataclasses.replace(arm.sample(), **{field: np.full(7, np.nan)})
        tick = arm.tracker.tick(arm.now, bad)
        assert np.isfinite(tick.command).all()
        arm.finished += tick.finished
    np.testing.assert_allclose(arm.q, good)
    assert codes(arm) == [ResultCode.FAULT]
    assert arm.tracker.conditions == Condition.BAD_SAMPLE
    assert arm.tracker.counters.faults == 1


def test_an_elbow_that_is_pushed_away_is_not_pulled_back(arm):
    started(arm)
    elsewhere = arm.q
    for _ in range(100):
        # Motion that leaves the tip alone: the null space of the Jacobian.
        along = np.linalg.svd(arm.kinematics.jacobian(elsewhere))[2][-1]
        arm.q = elsewhere = elsewhere + 0.005 * np.sign(along[2]) * along
        arm.tick()
        command, arm.q = arm.q, elsewhere
    assert codes(arm) == [ResultCode.FAULT]
    assert arm.tracker.latched
    assert np.abs(command - elsewhere).max() <= PROMPT.limits.joint_divergence
    np.testing.assert_allclose(arm.tracker.reference.position[:2], arm.tracker.tip[:2], atol=0.005)


def test_a_jump_is_not_believed_until_reset(arm):
    started(arm)
    command, tip = arm.q, arm.tracker.tip.copy()
    there = arm.q + np.array((0.0, 0.05, 0.0, 0.0, 0.0, 0.0, 0.0))
    for _ in range(100):
        arm.q = there
        arm.tick()
        np.testing.assert_allclose(arm.q, command, atol=1e-9)
    assert codes(arm) == [ResultCode.FAULT]
    assert arm.tracker.conditions == Condition.JUMPED
    np.testing.assert_array_equal(arm.tracker.tip, tip)
    arm.tracker.reset()
    arm.q = there
    arm.tick()
    assert not arm.tracker.latched


def test_measurements_that_stand_still_hold_the_command_within_three_of_them():
    """Row 16 of the fault matrix: within 10 ms (here 12, of a 4 ms cycle), at most 4 mm."""
    arm = PerfectArm(PROMPT)
    arm.tick()
    assert arm.tracker.offer(line((0.0, 0.0), (0.25, 0.0), 0.2), 0.0) is None
    arm.run(0.6)
    stuck, before = arm.q, arm.kinematics.tip(arm.q)
    tips = [before]
    for _ in range(50):
        arm.q = stuck
        arm.tick()
        tips.append(arm.kinematics.tip(arm.q))
    travelled = np.linalg.norm(tips - before, axis=1)
    assert arm.tracker.conditions == Condition.FROZEN
    assert codes(arm) == [ResultCode.FAULT]
    assert 0.0 < travelled.max() <= 0.004
    assert travelled[-1] == pytest.approx(travelled[3], abs=1e-6)
    assert np.linalg.norm(np.diff(tips, axis=0), axis=1).max() / PERIOD <= 0.25


def test_an_arm_at_rest_may_say_the_same_for_ever(arm):
    arm.run(2.0)
    arm.tracker.pause()
    arm.run(2.0)
    assert arm.tracker.conditions == Condition.PAUSED
