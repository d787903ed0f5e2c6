# SPDX-License-Identifier: Apache-2.0
"""The tracker on an arm without physics."""

import dataclasses

import numpy as np
from perfect_arm import PERIOD, PROMPT, PerfectArm, codes, started
import pytest
from segments import MS, chain, line, replaced

from lwr_tracking.core import ClockError
from lwr_tracking.core.refusal import Refusal
from srnn_msgs_py.result import ResultCode

LOOP = [(0.0, 0.0), (0.12, -0.1), (0.2, 0.05), (0.05, 0.15), (0.0, 0.0)]


@pytest.fixture
def arm():
    arm = PerfectArm(PROMPT)
    arm.tick()
    return arm


def test_it_takes_nothing_and_commands_nothing_before_the_first_measurement():
    arm = PerfectArm()
    result = arm.tracker.offer(line((0.0, 0.0), (0.1, 0.0), 0.1), 0.0)
    assert result.reason == Refusal.NOT_STARTED
    assert arm.tracker.reference is None
    bad = dataclasses.replace(arm.sample(), position=np.full(7, np.nan))
    assert arm.tracker.tick(0.0, bad).command is None


def test_the_first_command_is_where_the_arm_is():
    arm = PerfectArm(start=(0.1, -0.2))
    arm.q = arm.q + 0.01
    command = arm.tracker.tick(5.0, arm.sample()).command
    np.testing.assert_array_equal(command, arm.q)


def test_a_chain_is_executed_as_planned_and_reported_in_order(arm):
    segments = chain(LOOP, 0.15, duration=0.8)
    arm.execute(segments)
    assert codes(arm) == [ResultCode.DONE] * len(segments)
    for entry, segment in zip(arm.finished, segments, strict=True):
        assert entry.result.stamp_ns == entry.path.stamp_ns == segment.stamp_ns
        np.testing.assert_allclose(entry.path.positions, segment.positions, atol=3e-4)
    jumps = np.abs(np.diff(arm.velocities, axis=0)).max()
    assert jumps <= PROMPT.gate.acceleration_limit * PERIOD


def test_a_newer_successor_replaces_the_waiting_one(arm):
    first, second = chain([(0.0, 0.0), (0.2, 0.0)], 0.1, duration=1.2)
    newer = replaced(second, stamp_ns=second.stamp_ns + MS)
    for segment in (first, second, newer):
        assert arm.tracker.offer(segment, 0.0) is None
    arm.run(3.0)
    stamps = [(entry.result.stamp_ns, entry.result.code) for entry in arm.finished]
    assert stamps == [
        (second.stamp_ns, ResultCode.REJECTED),
        (first.stamp_ns, ResultCode.DONE),
        (newer.stamp_ns, ResultCode.DONE),
    ]
    assert arm.finished[0].result.reason == Refusal.SUPERSEDED
    assert arm.finished[0].path is None
    assert arm.tracker.counters.refused[Refusal.SUPERSEDED] == 1


def test_a_clean_stream_and_one_with_echoes_move_the_same():
    segments = chain(LOOP, 0.15, duration=0.8)
    clean, noisy = PerfectArm(), PerfectArm()
    clean.tick()
    noisy.tick()
    clean.execute(segments)
    for i, segment in enumerate(segments):
        assert noisy.tracker.offer(segment, 0.0) is None
        for echo in segments[: i + 1]:
            assert noisy.tracker.offer(echo, 0.0) is not None
        while noisy.tracker.reference.waiting or (
            i + 1 == len(segments) and len(noisy.finished) < len(segments)
        ):
            noisy.tick()
    same = min(len(clean.references), len(noisy.references))
    np.testing.assert_array_equal(clean.references[:same], noisy.references[:same])


def test_a_stop_freezes_at_once_and_holds_until_reset(arm):
    started(arm, speed=0.2, seconds=0.6)
    assert arm.tracker.offer(
        line((0.2, 0.0), (0.1, 0.0), 0.1, stamp_ns=2 * MS), 0.0
    ) is None
    arm.tracker.stop()
    where = arm.tracker.tip.copy()
    arm.run(0.5)
    np.testing.assert_allclose(arm.tracker.tip[:2], where[:2], atol=1e-4)
    (fault, path), (dropped, nothing) = arm.finished
    assert (fault.code, fault.reason) == (ResultCode.FAULT, 'stop asked for')
    assert 0.0 < fault.values['progress'] < 1.0
    np.testing.assert_allclose(path.positions[-1], where[:2])
    assert (dropped.code, dropped.reason, nothing) == (
        ResultCode.REJECTED, Refusal.STOPPED, None,
    )
    onward = line(tuple(where[:2]), (0.0, 0.1), 0.1, stamp_ns=3 * MS)
    assert arm.tracker.offer(onward, 0.0).reason == 'stopped until reset: stop asked for'
    before = arm.q.copy()
    arm.tracker.reset()
    arm.tick()
    np.testing.assert_allclose(arm.q, before, atol=1e-4)
    assert arm.tracker.offer(onward, 0.0) is None


def test_a_pause_rests_on_the_path_and_resumes(arm):
    started(arm)
    arm.tracker.pause()
    arm.run(0.5)
    assert arm.tracker.reference.at_rest
    other = line((0.2, 0.0), (0.1, 0.0), 0.1, stamp_ns=2 * MS)
    assert arm.tracker.offer(other, 0.0).reason == Refusal.PAUSED
    assert arm.finished == []
    arm.tracker.resume()
    arm.run(2.5)
    assert codes(arm) == [ResultCode.DONE]
    plan = line((0.0, 0.0), (0.2, 0.0), 0.1)
    np.testing.assert_allclose(arm.finished[0].path.positions, plan.positions, atol=1e-3)


def test_a_touch_blocks_the_segment_where_the_arm_is(arm):
    started(arm)
    arm.push = np.array((-12.0, 0.0, 0.0))
    arm.run(2 * PERIOD)
    result, path = arm.finished[0]
    assert result.code is ResultCode.BLOCKED
    assert result.reason == 'contact force'
    assert result.values['force_n'] == pytest.approx(12.0, abs=0.01)
    tip = (result.values['x'], result.values['y'])
    np.testing.assert_allclose(path.positions[-1], tip)
    assert result.values['progress'] == pytest.approx(1.0 / 2.3, abs=0.02)
    assert arm.tracker.reference.running is None
    assert arm.tracker.counters.contacts == 1
    back = line(tip, (0.0, 0.0), 0.1, stamp_ns=2 * MS)
    assert arm.tracker.offer(back, 0.0) is None
    arm.push = np.zeros(3)
    arm.run(2.0)
    assert codes(arm)[1:] == [ResultCode.DONE]


def test_one_sample_is_no_touch_and_force_at_rest_neither(arm):
    arm.push = np.array((30.0, 0.0, 0.0))
    arm.run(0.1)
    arm.push = np.zeros(3)
    arm.run(0.1)
    started(arm, seconds=0.5)
    arm.push = np.array((30.0, 0.0, 0.0))
    arm.tick()
    arm.push = np.zeros(3)
    arm.run(3.0)
    assert codes(arm) == [ResultCode.DONE]
    assert arm.tracker.counters.contacts == 0


def test_the_integral_does_not_wind_up_under_load(arm):
    arm.run(0.1)
    before = arm.tracker.correction
    arm.push = np.array((8.0, 0.0, 0.0))
    held = arm.q
    for _ in range(250):
        arm.tick()
        arm.q = held + 0.002
    np.testing.assert_allclose(arm.tracker.correction, before, atol=5e-5)


def test_an_arm_pushed_at_rest_gives_way(arm):
    arm.q = arm.kinematics.inverse((0.008, 0.0, 0.0), arm.q)
    pushed = arm.q
    for _ in range(3):
        arm.tick()
        arm.q = pushed
    assert arm.tracker.reference.position[0] == pytest.approx(0.008, abs=1e-6)
    assert arm.tracker.counters.yields == 1
    assert arm.finished == []


def test_time_that_stands_still_or_leaps_moves_little(arm):
    started(arm)
    for leap in (0.0, -10.0, 3600.0):
        before = arm.references[-1]
        arm.tick(leap)
        moved = np.linalg.norm(arm.references[-1] - before)
        assert moved <= 0.1 * PROMPT.limits.max_step * 1.001
    with pytest.raises(ClockError):
        arm.tracker.tick(np.nan, arm.sample())


def test_two_runs_are_bit_identical():
    def commands():
        arm = PerfectArm()
        arm.tick()
        arm.execute(chain(LOOP, 0.2, duration=0.7))
        return arm.q.tobytes(), [entry.path.positions.tobytes() for entry in arm.finished]

    assert commands() == commands()


def test_the_counters_tell_what_happened(arm):
    first, second = chain([(0.0, 0.0), (0.2, 0.0)], 0.1, duration=1.2)
    assert arm.tracker.offer(first, 0.0) is None
    assert arm.tracker.offer(first, 0.0) is not None
    assert arm.tracker.offer(second, 1.0).code is ResultCode.STALE
    while not arm.tracker.reference.join()[1]:
        arm.tick()
    assert arm.tracker.offer(second, 0.0).reason == Refusal.LATE
    arm.run(0.5)
    counters = dataclasses.asdict(arm.tracker.counters)
    assert counters.pop('refused') == {Refusal.DUPLICATE: 1, Refusal.STALE: 1, Refusal.LATE: 1}
    expected = {'accepted': 1, 'contacts': 0, 'yields': 0, 'faults': 0, 'soft_stops': 1}
    assert counters == {**expected, 'late_ticks': 0}
    assert arm.tracker.counters.late == 1
