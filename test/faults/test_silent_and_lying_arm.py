# SPDX-License-Identifier: Apache-2.0
"""What the arm does when measurements or commands fail. Simulated time only."""

from dataclasses import replace

from arm_rig import PERIOD, PHYSICS_PER_TICK, Rig, rig
import numpy as np
import pytest
from segments import line

from lwr_tracking.core.failsafe import Condition
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.result import ResultCode

SPEEDS = pytest.mark.parametrize('speed', [0.05, 0.1, 0.2])
ANGLES = pytest.mark.parametrize('angle', np.linspace(0.0, 2.0 * np.pi, 7)[:-1])


def moving(speed: float, angle: float) -> Rig:
    """Return the arm in the middle of a straight segment."""
    made = rig()
    end = 0.25 * np.array((np.cos(angle), np.sin(angle)))
    assert made.tracker.offer(line((0.0, 0.0), tuple(end), speed), 0.0) is None
    made.run(0.12 / speed)
    return made


def coast(made: Rig, seconds: float) -> np.ndarray:
    """Let the arm alone, without commands; return its tip every millisecond (n, 3)."""
    tips = []
    for _ in range(round(seconds / 0.001)):
        made.arm.step()
        tips.append(made.arm.tip_truth.copy())
    return np.array(tips)


def speeds(tips: np.ndarray, period: float) -> np.ndarray:
    return np.linalg.norm(np.diff(tips, axis=0), axis=1) / period


@SPEEDS
@ANGLES
def test_without_a_tracker_the_arm_holds_within_20_ms_and_stands_soon(speed, angle):
    """Row 4 of the fault matrix: at most 15 mm, at rest within 510 ms."""
    made = moving(speed, angle)
    before = made.arm.tip_truth.copy()
    tips = coast(made, 0.021)
    assert made.arm.watch.holding
    tips = np.concatenate([tips, coast(made, 1.0)])
    assert np.linalg.norm(tips - before, axis=1).max() <= 0.015
    moving_still = np.flatnonzero(speeds(tips, 0.001) > 0.005)
    assert moving_still.max(initial=0) * 0.001 <= 0.51
    assert abs(tips[-1, 2] - before[2]) <= 0.002
    assert made.arm.watch.holds == 1


@SPEEDS
@pytest.mark.parametrize('lost', [1, 2, 3])
def test_a_few_lost_commands_are_made_up_for(speed, lost):
    """Row 7: the arm waits for the next command, and goes on as if nothing had been."""
    made = moving(speed, 0.3)
    for _ in range(lost):
        made.arm.step(PHYSICS_PER_TICK)
        made.tips.append(made.arm.tip_truth)
    made.run(0.5 / speed)
    assert [entry.result.code for entry in made.finished] == [ResultCode.DONE]
    assert not made.arm.watch.holds
    assert np.hypot(*(made.tips[-1][:2] - made.tracker.reference.position[:2])) <= 1e-3
    assert speeds(np.array(made.tips), PERIOD).max() <= 0.25


def frozen(sample: JointSample, at: JointSample) -> JointSample:
    """Return a measurement with a new stamp and old content."""
    return replace(at, stamp_ns=sample.stamp_ns)


def stamped(sample: JointSample, at: JointSample) -> JointSample:
    """Return an old measurement, sent again."""
    return at


@SPEEDS
@ANGLES
@pytest.mark.parametrize('fault', [frozen, stamped])
def test_measurements_that_stand_still_stop_the_arm(speed, angle, fault):
    """Row 16: at most 4 mm and 0.25 m/s during the fault; a freeze overshoots by 2 mm."""
    made = moving(speed, angle)
    at, told, tips = made.arm.sample(int(made.arm.time * 1e9)), [], []
    made.tracker.tick(made.arm.time, at)
    for _ in range(100):
        sample = fault(made.arm.sample(int(made.arm.time * 1e9)), at)
        tick = made.tracker.tick(made.arm.time, sample)
        assert made.arm.command(tick.command) is None
        made.arm.step(PHYSICS_PER_TICK)
        told.append(tick.command)
        tips.append(made.arm.tip_truth.copy())
    assert made.tracker.conditions == Condition.FROZEN
    stopped = np.flatnonzero(np.abs(np.diff(told, axis=0)).max(axis=1)).max(initial=-1) + 1
    assert stopped * PERIOD * speed <= 0.004
    assert np.linalg.norm(np.array(tips) - made.tips[-1], axis=1).max() <= 0.006
    assert speeds(np.array(tips), PERIOD).max() <= 0.25


@SPEEDS
@pytest.mark.parametrize('joint', range(7))
@pytest.mark.parametrize('value', [np.nan, np.inf, 0.2, -10.0])
def test_a_measurement_that_is_not_true_is_not_followed(speed, joint, value):
    """Row 17: the command stays where it is, and the arm comes to rest there."""
    made = moving(speed, 1.0)
    before = made.arm.tip_truth.copy()
    for _ in range(100):
        sample = made.arm.sample(int(made.arm.time * 1e9))
        sample.position[joint] += value
        tick = made.tracker.tick(made.arm.time, sample)
        assert made.arm.command(tick.command) is None
        made.arm.step(PHYSICS_PER_TICK)
    assert made.tracker.latched
    assert np.linalg.norm(made.arm.tip_truth - before) <= 0.006
    made.tracker.reset()
    made.run(0.5)
    assert not made.tracker.latched
    assert np.linalg.norm(made.arm.tip_truth - before) <= 0.006


@pytest.mark.parametrize('leap_s', [-10.0, 3600.0])
def test_a_system_clock_that_is_set_changes_no_command(leap_s):
    """Row 15: the loop runs on the steady clock; stamps only tell one measurement from another."""

    def commands(leap_ns: int) -> bytes:
        made, told = moving(0.2, 2.0), []
        for k in range(250):
            stamp = int(made.arm.time * 1e9) + 10**11 + (leap_ns if k > 100 else 0)
            tick = made.tracker.tick(made.arm.time, made.arm.sample(stamp))
            assert made.arm.command(tick.command) is None
            made.arm.step(PHYSICS_PER_TICK)
            told.append(tick.command.tobytes())
        assert not made.tracker.conditions
        return b''.join(told)

    assert commands(round(leap_s * 1e9)) == commands(0)
