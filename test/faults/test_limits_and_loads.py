# SPDX-License-Identifier: Apache-2.0
"""Rows 18 to 21 and 23: limits of the arm, an overloaded machine, a contact that does not end."""

from dataclasses import replace

from arm_rig import PERIOD, PHYSICS_PER_TICK, Rig, rig
import numpy as np
from perfect_arm import PROMPT, PerfectArm, swivelled
import pytest
from segments import MS, line

from lwr_description import POSITION_MAX, TORQUE_MAX, VELOCITY_MAX
from lwr_tracking.core import LawParameters, LimitParameters
from lwr_tracking.core.failsafe import Condition
from srnn_msgs_py.result import ResultCode

FORCED = replace(PROMPT, law=LawParameters(lead=PERIOD, posture_gain=0.0, integral_gain=0.0))
TICK_MS = 1e3 * PERIOD
PATIENCE_MS = 20.0 + TICK_MS


@pytest.fixture
def rng():
    return np.random.default_rng(18)


def drive(arm: PerfectArm, rng, entry, check) -> None:
    """Move from the centre in a random direction until the arm stops; `check` every tick."""
    angle, speed = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(0.05, 0.23)
    end = 0.28 * np.array((np.cos(angle), np.sin(angle)))
    assert arm.tracker.offer(line((0.0, 0.0), tuple(end), speed), 0.0) is None
    entry.speed = 0.0
    for _ in range(round(4.0 / speed / PERIOD)):
        before, tip = arm.q, arm.kinematics.tip(arm.q)
        arm.tick()
        entry.speed = max(
            entry.speed, float(np.linalg.norm(arm.kinematics.tip(arm.q) - tip)) / PERIOD
        )
        assert (np.abs(arm.q - before) <= VELOCITY_MAX * PERIOD).all()
        check(arm)
        if arm.finished:
            break
    assert entry.speed <= 0.25
    assert arm.finished


def test_row_18_a_joint_comes_to_its_limit(ledger, rng):
    def inside(arm):
        assert (POSITION_MAX - np.abs(arm.q)).min() >= np.radians(2.0)

    stopped = 0
    for _ in range(ledger.repeats):
        with ledger.injection(18, 'joint driven to its limit') as entry:
            arm = PerfectArm(FORCED)
            arm.q = swivelled(np.radians(6.0))
            arm.tick()
            drive(arm, rng, entry, inside)
            stopped += arm.tracker.conditions == Condition.JOINT_LIMIT
    assert stopped


def test_row_19_the_posture_becomes_singular(ledger, rng):
    limits = LimitParameters(singular=0.235, slow_singular=0.245)

    def dexterous(arm):
        assert np.linalg.svd(arm.kinematics.jacobian(arm.q))[1].min() >= limits.singular

    stopped = 0
    for _ in range(ledger.repeats):
        with ledger.injection(19, 'posture driven towards a singular one') as entry:
            arm = PerfectArm(replace(FORCED, limits=limits))
            arm.tick()
            drive(arm, rng, entry, dexterous)
            stopped += arm.tracker.conditions == Condition.SINGULAR
    assert stopped


def moving(rng) -> Rig:
    """Return the simulated arm in the middle of a segment of random speed and direction."""
    made, speed, angle = rig(), rng.uniform(0.05, 0.23), rng.uniform(0.0, 2.0 * np.pi)
    end = 0.25 * np.array((np.cos(angle), np.sin(angle)))
    assert made.tracker.offer(line((0.0, 0.0), tuple(end), speed), 0.0) is None
    made.run(rng.uniform(0.04, 0.16) / speed)
    return made


def follow(made: Rig, entry, seconds: float, alter=lambda sample: sample, step: int = 1):
    """Go on for a while, a command every `step` cycles; return when it stopped, None if not [ms].

    The tracker hears measurements as `alter` makes them.
    """
    start, before, stopped = made.arm.tip_truth.copy(), made.arm.tip_truth.copy(), None
    entry.deviation_mm = entry.speed = 0.0
    for k in range(round(seconds / PERIOD)):
        if k % step == 0:
            sample = alter(made.arm.sample(int(made.arm.time * 1e9)))
            tick = made.tracker.tick(made.arm.time, sample)
            assert made.arm.command(tick.command) is None
            made.finished += tick.finished
            if stopped is None and made.tracker.latched:
                stopped = TICK_MS * (k + 1)
        made.arm.step(PHYSICS_PER_TICK)
        tip = made.arm.tip_truth.copy()
        entry.speed = max(entry.speed, float(np.linalg.norm(tip - before)) / PERIOD)
        if stopped is None:
            start = tip
        entry.deviation_mm = max(entry.deviation_mm, 1e3 * float(np.linalg.norm(tip - start)))
        before = tip
    return stopped


def test_row_20_a_joint_is_at_the_limit_of_its_torque(ledger, rng):
    for _ in range(ledger.repeats):
        with ledger.injection(20, 'torque saturated', bound_ms=PATIENCE_MS) as entry:
            made, joint = moving(rng), rng.integers(7)

            def saturated(sample, joint=joint):
                torque = sample.torque.copy()
                torque[joint] = rng.choice((-1.0, 1.0)) * TORQUE_MAX[joint]
                return replace(sample, torque=torque)

            entry.reaction_ms = follow(made, entry, 0.5, saturated)
            assert entry.reaction_ms is not None
            assert made.tracker.conditions == Condition.SATURATED
            assert entry.deviation_mm <= 6.0
            assert entry.speed <= 0.25


def test_row_21_measurements_are_answered_late(ledger, rng):
    for _ in range(ledger.repeats):
        with ledger.injection(21, 'every tick late, two or three periods apart') as entry:
            made = moving(rng)
            path = made.tracker.reference.running.path
            follow(made, entry, 1.0, step=int(rng.integers(2, 4)))
            assert made.tracker.conditions == Condition.OVERLOADED
            assert made.tracker.reference.at_rest
            assert entry.speed <= 0.25
            # At rest, and on the path.
            p, _, _ = path.evaluate(np.linspace(0.0, path.duration, 2000))
            off = np.linalg.norm(p - made.arm.tip_truth[:2], axis=1).min()
            entry.deviation_mm = 1e3 * float(off)
            assert entry.deviation_mm <= 2.0
            made.run(8.0)
            assert [end.result.code for end in made.finished] == [ResultCode.DONE]


def wall(angle: float) -> dict[str, object]:
    """Return a long wall whose face is 0.1 m from the centre, seen at an angle [rad]."""
    centre = 0.16 * np.array((np.cos(angle), np.sin(angle)))
    return {'shape': 'box', 'center': centre.tolist(), 'size': [0.10, 0.30], 'yaw': float(angle)}


def test_row_23_whoever_presses_on_the_same_place_is_stopped(ledger, rng):
    for _ in range(ledger.repeats):
        with ledger.injection(23, 'segment after segment into a wall') as entry:
            angle, speed = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(0.05, 0.2)
            made = rig([wall(angle)])
            end, stamp = tuple(0.2 * np.array((np.cos(angle), np.sin(angle)))), MS
            while not made.tracker.latched:
                start = tuple(made.tracker.reference.position[:2])
                stamp += MS
                # What the gate refuses is too near to the wall: wait, as a planner would.
                made.tracker.offer(line(start, end, speed, stamp), 0.0)
                made.run(0.1)
                assert made.arm.time < 60.0
            assert made.tracker.conditions == Condition.REPEATED
            assert made.tracker.counters.contacts == 4
            assert max(made.force) < 80.0
            held = made.arm.tip_truth.copy()
            made.run(1.0)
            entry.deviation_mm = 1e3 * float(np.linalg.norm(made.arm.tip_truth - held))
            assert entry.deviation_mm <= 3.0
