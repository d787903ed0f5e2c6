# SPDX-License-Identifier: Apache-2.0
"""The tracker on the simulated arm: accuracy, contact, no false contact. Simulated time only."""

from pathlib import Path
import sys

from arm_rig import PERIOD, PHYSICS_PER_TICK, rig
import numpy as np
import pytest

from lwr_description import Kinematics, Mount
from lwr_guard import GuardParameters
from lwr_sim_bridge.parameters import ContactParameters, MismatchParameters
from lwr_tracking.core import Tracker, TrackerParameters
from lwr_tracking.core.tick_watch import HELD_AFTER
from srnn_msgs_py.result import ResultCode

sys.path.insert(0, str(Path(__file__).parents[1] / 'src' / 'lwr_tracking' / 'test'))
from segments import MS, chain, line

LAP = [
    (0.26, 0.1), (0.18, 0.25), (0, 0.27), (-0.18, 0.25), (-0.26, 0.1), (-0.26, -0.1),
    (-0.18, -0.25), (0, -0.27), (0.18, -0.25), (0.26, -0.1),
]
PLANE = [(0, 0), (0.15, 0.0), *LAP, (0.15, 0.05), (0, 0.05), (-0.12, -0.1)]
HARSH = MismatchParameters(mass_scale=1.1, payload=0.2, friction=(0.5,) * 7)


def errors(finished, segments) -> np.ndarray:
    """Return the distance of executed from planned positions, all segments together [m]."""
    assert [entry.result.code for entry in finished] == [ResultCode.DONE] * len(segments)
    pairs = zip(finished, segments, strict=True)
    offsets = np.concatenate([entry.path.positions - plan.positions for entry, plan in pairs])
    return np.hypot(*offsets.T)


@pytest.mark.parametrize(('speed', 'rmse', 'worst'), [(0.1, 5e-4, 2e-3), (0.2, 1e-3, 3e-3)])
def test_the_executed_path_is_the_planned_one(speed, rmse, worst):
    arm, segments = rig(), chain(PLANE, speed)
    arm.execute(segments)
    error = errors(arm.finished, segments)
    assert np.sqrt(np.mean(error**2)) <= rmse
    assert error.max() <= worst
    assert arm.tracker.counters.contacts == 0
    assert max(arm.force) < 0.5 * TrackerParameters().contact.force
    height = np.abs(np.array(arm.tips)[:, 2])
    assert height.max() < 1e-3


@pytest.mark.slow
@pytest.mark.parametrize('speed', [0.1, 0.2])
def test_a_minute_with_a_badly_known_arm_has_no_false_contact(speed):
    arm = rig(seed=4, mismatch=HARSH)
    laps = round(40.0 * speed)
    segments = chain([(0, 0), (0.15, 0.0), *(LAP * laps)], speed)
    arm.execute(segments)
    error = errors(arm.finished, segments)
    assert arm.arm.time > 60.0
    assert np.sqrt(np.mean(error**2)) <= 2e-3
    assert max(arm.force) < 0.75 * TrackerParameters().contact.force


@pytest.mark.parametrize('surface', [0.004, 0.02])
@pytest.mark.parametrize(('speed', 'deadline'), [(0.05, 0.150), (0.1, 0.075), (0.2, 0.075)])
@pytest.mark.parametrize('angle', [0.0, 1.6, -2.3])
def test_a_contact_stops_the_arm_softly(speed, deadline, angle, surface):
    ahead = np.array((np.cos(angle), np.sin(angle)))
    disc = {'shape': 'disc', 'center': (0.12 * ahead).tolist(), 'radius': 0.05}
    arm = rig([disc], contact=ContactParameters(time_constant=surface))
    assert arm.tracker.offer(line((0.0, 0.0), tuple(0.2 * ahead), speed), 0.0) is None
    touched = None
    while not arm.finished:
        arm.tick()
        if touched is None and arm.arm.truth.peak > 0.0:
            touched = arm.arm.time
    result, path = arm.finished[0]
    assert result.code is ResultCode.BLOCKED
    assert arm.arm.time - touched <= deadline
    held = np.array((result.values['x'], result.values['y']))
    np.testing.assert_array_equal(path.positions[-1], held)
    since = len(arm.tips)
    arm.run(0.1)
    assert arm.present_force() <= 10.0
    arm.run(0.3)
    assert arm.arm.truth.peak <= 60.0
    overshoot = np.hypot(*(np.array(arm.tips)[since:, :2] - held).T)
    assert overshoot.max() <= 4e-3
    arm.execute([line(tuple(held), (0.0, 0.0), speed, stamp_ns=2 * MS)])
    assert arm.finished[1].result.code is ResultCode.DONE


def test_pressing_on_after_a_contact_is_noticed_again():
    disc = {'shape': 'disc', 'center': [0.12, 0.0], 'radius': 0.05}
    arm = rig([disc])
    for number in range(1, 4):
        x, y = arm.tracker.reference.position[:2]
        assert arm.tracker.offer(line((x, y), (0.2, 0.0), 0.1, stamp_ns=number * MS), 0.0) is None
        while len(arm.finished) < number:
            arm.tick()
        arm.run(0.1)
    assert {entry.result.code for entry in arm.finished} == {ResultCode.BLOCKED}
    assert arm.arm.truth.peak <= 60.0


def test_a_stop_at_speed_overshoots_little_and_holds():
    arm = rig()
    assert arm.tracker.offer(line((0.0, 0.0), (0.25, 0.0), 0.2), 0.0) is None
    arm.run(0.7)
    arm.tracker.stop()
    where = arm.arm.tip_truth
    since = len(arm.tips)
    arm.run(0.6)
    away = np.linalg.norm(np.array(arm.tips)[since:] - where, axis=1)
    assert away.max() <= 5e-3
    still = np.array(arm.tips)[since + round(0.2 / PERIOD):]
    assert np.ptp(still, axis=0).max() < 1.5e-3
    arm.tracker.reset()
    before = arm.arm.tip_truth
    arm.run(0.2)
    assert np.linalg.norm(arm.arm.tip_truth - before) < 5e-4


def test_a_silent_planner_leaves_the_arm_at_rest_on_its_path():
    moving = chain([(0.0, 0.0), (0.2, 0.0)], 0.2, duration=0.6)[0]
    arm = rig()
    arm.execute([moving])
    arm.run(0.5)
    assert arm.tracker.counters.soft_stops == 1
    np.testing.assert_allclose(arm.arm.tip_truth[:2], moving.positions[-1], atol=1.5e-3)
    assert np.array(arm.tips)[:, 0].max() <= moving.positions[-1, 0] + 2e-3


def test_the_tracker_knows_when_the_arm_holds_its_pose():
    assert GuardParameters().silence == HELD_AFTER


@pytest.mark.parametrize('seconds', [0.03, 0.07, 0.09, 0.12, 0.3])
def test_an_arm_left_without_commands_for_a_moment_does_not_hurry_afterwards(seconds):
    arm, speed, cycles = rig(), 0.2, 5
    ends = (-0.2, 0.0), (0.2, 0.0)
    arm.execute([line((0.0, 0.0), ends[0], speed)])
    for number in range(1, 7):
        since = len(arm.tips)
        path = line(ends[number % 2 - 1], ends[number % 2], speed, number * MS + MS)
        assert arm.tracker.offer(path, 0.0) is None
        arm.run(0.3 + 0.2 * number)
        for _ in range(round(seconds / PERIOD)):
            arm.arm.step(PHYSICS_PER_TICK)
            arm.tips.append(arm.arm.tip_truth)
        while arm.tracker.reference.running:
            arm.tick()
        tips = np.array(arm.tips[since:])
        moved = np.linalg.norm(tips[cycles:] - tips[:-cycles], axis=1)
        assert moved.max() / (PERIOD * cycles) < 1.06 * speed
    assert {entry.result.code for entry in arm.finished} == {ResultCode.DONE}


def test_an_arm_that_does_not_start_in_the_plane_is_brought_there_gently():
    arm = rig()
    scene_height = arm.tracker.tip[2]
    fresh = Tracker(TrackerParameters(), Kinematics(Mount()))
    lifted = Kinematics(Mount()).inverse((0.0, 0.0, 0.04))
    q = Kinematics(Mount()).inverse((0.0, 0.0, 0.0))
    for share in np.linspace(0.0, 1.0, 500):
        arm.arm.command(q + share * (lifted - q))
        for _ in range(PHYSICS_PER_TICK):
            arm.arm.step()
    arm.tracker = fresh
    arm.tips.clear()
    arm.run(5.0)
    height = np.array(arm.tips)[:, 2]
    assert height[0] > 0.035
    assert abs(height[-1]) < 5e-4
    assert abs(scene_height) < 5e-4
    assert np.abs(np.diff(height)).max() / PERIOD < 0.03
