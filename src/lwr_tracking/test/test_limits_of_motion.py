# SPDX-License-Identifier: Apache-2.0
"""The tracker near joint limits and singular postures, overloaded, loaded, and pressed on."""

import dataclasses
from itertools import count

import numpy as np
from perfect_arm import PERIOD, PROMPT, PerfectArm, codes, started, swivelled
import pytest
from segments import MS, line

from lwr_description import POSITION_MAX, VELOCITY_MAX, Kinematics, Mount
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.parameters import LawParameters, LimitParameters
from lwr_tracking.core.refusal import Refusal
from lwr_tracking.core.tracking_law import TrackingLaw
from srnn_msgs_py.result import ResultCode

TWO_DEGREES, FIVE_DEGREES = np.radians((2.0, 5.0))
STRETCHED = dataclasses.replace(
    PROMPT, law=LawParameters(lead=PERIOD, posture_gain=0.0, integral_gain=0.0)
)


def near_a_limit():
    """Return an arm whose posture is forced to within 7 degrees of the limit of a joint."""
    arm = PerfectArm(STRETCHED)
    arm.q = swivelled(np.radians(7.0))
    arm.tick()
    return arm


def run_in_all_directions(make, distance=0.25):
    """Run a line in every direction; return the arm of each."""
    arms = []
    for angle in np.linspace(0.0, 2.0 * np.pi, 9)[:-1]:
        arm = make()
        end = arm.tracker.tip[:2] + distance * np.array((np.cos(angle), np.sin(angle)))
        start = tuple(arm.tracker.tip[:2])
        assert arm.tracker.offer(line(start, tuple(end), 0.2), 0.0) is None
        for _ in range(round(4.0 * distance / 0.2 / PERIOD)):
            before = arm.q
            arm.tick()
            margin = (POSITION_MAX - np.abs(arm.q)).min()
            assert margin >= LimitParameters().position_margin - 1e-12
            assert np.all(np.abs(arm.q - before) <= VELOCITY_MAX * PERIOD)
        arms.append(arm)
    return arms


def test_a_joint_limit_is_approached_slowly_and_stops_the_arm():
    arms = run_in_all_directions(near_a_limit)
    stopped = [arm for arm in arms if arm.tracker.conditions == Condition.JOINT_LIMIT]
    assert stopped
    for arm in stopped:
        assert codes(arm) == [ResultCode.FAULT]
        assert arm.finished[0].result.reason == 'joint at its limit'
        assert TWO_DEGREES <= (POSITION_MAX - np.abs(arm.q)).min() < FIVE_DEGREES
    # The others had another way to go.
    assert all(codes(arm) == [ResultCode.DONE] for arm in arms if arm not in stopped)


def test_from_a_joint_limit_the_arm_can_go_back_after_a_reset():
    arm = next(a for a in run_in_all_directions(near_a_limit) if a.tracker.latched)
    assert arm.tracker.offer(line(arm.tracker.tip[:2], (0.0, 0.0), 0.1, 2 * MS), 0.0) is not None
    arm.tracker.reset()
    before = arm.q
    arm.run(0.5)
    np.testing.assert_allclose(arm.q, before, atol=1e-3)
    back = line(tuple(arm.tracker.tip[:2]), (0.0, 0.0), 0.1, 3 * MS)
    arm.finished.clear()
    arm.execute([back])
    assert codes(arm) == [ResultCode.DONE]


def test_near_a_limit_motion_is_slower():
    law = TrackingLaw(STRETCHED.law, STRETCHED.limits, Kinematics(Mount()))
    arm = near_a_limit()
    law.start(arm.q)
    joint, speeds = np.argmin(POSITION_MAX - np.abs(arm.q)), []
    toward = np.sign(arm.q[joint]) * arm.kinematics.jacobian(arm.q)[:, joint]
    for _ in range(2000):
        before = law.command
        law.step(arm.kinematics.tip(before) + 0.001 * toward / np.linalg.norm(toward), PERIOD)
        left = (POSITION_MAX - np.abs(before)).min()
        speeds.append((left, np.abs(law.command - before).max() / PERIOD))
    far = [speed for left, speed in speeds if left > FIVE_DEGREES]
    near = [speed for left, speed in speeds if left < 0.7 * FIVE_DEGREES]
    assert max(near) < 0.6 * np.median(far)


def test_the_arm_does_not_stretch_into_a_singular_posture():
    def stretched():
        arm = PerfectArm(dataclasses.replace(
            STRETCHED, limits=LimitParameters(singular=0.22, slow_singular=0.24)
        ))
        arm.tick()
        return arm

    arms = run_in_all_directions(stretched, distance=0.28)
    stopped = [arm for arm in arms if arm.tracker.conditions == Condition.SINGULAR]
    assert stopped
    for arm in arms:
        smallest = np.linalg.svd(arm.kinematics.jacobian(arm.q))[1].min()
        assert smallest >= 0.22
        assert codes(arm) == [ResultCode.FAULT if arm in stopped else ResultCode.DONE]


@pytest.mark.parametrize('name', ['singular', 'position_margin'])
def test_zones_that_are_inside_out_are_refused(name):
    slow = {'singular': 'slow_singular', 'position_margin': 'slow_margin'}[name]
    with pytest.raises(ValueError, match=slow):
        LimitParameters(**{name: 0.2, slow: 0.2})


def test_an_overload_brings_the_arm_to_rest_on_its_path_until_it_is_over():
    arm = PerfectArm(PROMPT)
    arm.tick()
    started(arm, seconds=0.5)
    for _ in range(100):
        arm.tick(2.0 * PERIOD)
    assert arm.tracker.conditions == Condition.OVERLOADED
    assert arm.tracker.reference.at_rest
    assert abs(arm.tracker.tip[1]) < 1e-4
    assert not arm.finished
    assert arm.tracker.counters.late_ticks == 100
    arm.run(4.0)
    assert codes(arm) == [ResultCode.DONE]
    assert not arm.tracker.conditions


@pytest.mark.parametrize('gap', [0.11, 3.0])
def test_after_a_gap_the_arm_goes_on_gently_from_where_it_is(gap):
    arm = PerfectArm(PROMPT)
    arm.tick()
    started(arm, speed=0.2, seconds=0.5)
    arm.tick(gap)
    arm.run(0.5)
    limits = PROMPT.limits
    speeds = np.linalg.norm(arm.velocities, axis=1)
    after = speeds[-126:]
    assert after[0] <= 1.01 * limits.braking * limits.max_step
    assert np.diff(after).max() <= 1.01 * limits.braking * PERIOD
    assert after[-1] == pytest.approx(0.2, rel=1e-3)
    steps = np.linalg.norm(np.diff(arm.references, axis=0), axis=1)
    assert steps[-126:].max() <= 1.001 * 0.2 * PERIOD


def test_a_tip_that_is_loaded_at_rest_is_not_moved():
    arm = PerfectArm(PROMPT)
    arm.push = np.array((6.0, 0.0, 0.0))
    arm.run(0.2)
    refused = arm.tracker.offer(line((0.0, 0.0), (0.2, 0.0), 0.1), 0.0)
    assert refused.reason == Refusal.LOADED
    assert arm.tracker.conditions == Condition.LOADED
    arm.push = np.zeros(3)
    arm.run(0.2)
    assert not arm.tracker.conditions
    assert arm.tracker.offer(line((0.0, 0.0), (0.2, 0.0), 0.1), 0.0) is None
    # Once in motion, a load after a contact is how learning looks.
    arm.run(0.5)
    arm.push = np.array((-12.0, 0.0, 0.0))
    arm.run(0.1)
    assert codes(arm) == [ResultCode.BLOCKED]
    away = line(tuple(arm.tracker.tip[:2]), (-0.1, 0.0), 0.1, 2 * MS)
    assert arm.tracker.offer(away, 0.0) is None


def test_segment_after_segment_against_the_same_place_stops_the_arm_until_reset():
    arm = PerfectArm(PROMPT)
    arm.tick()
    stamps = count(MS, MS)
    for number in range(4):
        assert not arm.tracker.latched
        arm.push = np.zeros(3)
        arm.run(0.02)
        ahead = line(tuple(arm.tracker.tip[:2]), (0.2, 0.0), 0.1, next(stamps))
        assert arm.tracker.offer(ahead, 0.0) is None
        arm.run(0.08)
        arm.push = np.array((-12.0, 0.0, 0.0))
        arm.run(0.02)
        assert codes(arm) == [ResultCode.BLOCKED] * (number + 1)
    assert arm.tracker.conditions == Condition.REPEATED
    refused = arm.tracker.offer(line((0.0, 0.0), (0.2, 0.0), 0.1, next(stamps)), 0.0)
    assert refused.reason == 'stopped until reset: contact at the same place again and again'
    arm.tracker.reset()
    assert not arm.tracker.latched


@pytest.mark.slow
def test_a_million_ticks_of_random_targets_touch_no_joint_limit():
    rng = np.random.default_rng(3)
    law = TrackingLaw(LawParameters(), LimitParameters(), Kinematics(Mount()))
    bound = POSITION_MAX - LimitParameters().position_margin
    for k in range(1_000_000):
        if k % 500 == 0:
            target = rng.uniform(-1.5, 1.5, 3)
        law.step(target, PERIOD)
        assert (np.abs(law.command) <= bound).all()
