# SPDX-License-Identifier: Apache-2.0
"""Laws of the reference: chains without jumps, soft stops on the path, pauses."""

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest
from segments import MS, RAMP, chain, line

from lwr_tracking.core.parameters import LimitParameters, TrackerParameters
from lwr_tracking.core.quintic_path import PathState
from lwr_tracking.core.reference import Reference
from lwr_tracking.core.refusal import Refusal
from lwr_tracking.core.segment_gate import Admission, Join, judge

PARAMETERS = TrackerParameters()
LIMITS = LimitParameters()
DT = 0.004
LOOP = [(0.0, 0.0), (0.15, -0.15), (0.22, 0.02), (0.1, 0.18), (-0.15, 0.1), (0.0, 0.0)]


def offer(reference, segment):
    state, late = reference.join()
    verdict = judge(segment, Join(state, late), 0.0, PARAMETERS)
    if isinstance(verdict, Admission):
        reference.accept(verdict)
    return verdict


def run(reference, segments, steps):
    """Offer segments as there is room; return time, position, velocity, names of the ended."""
    todo, ended, rows = list(segments), [], []
    time = 0.0
    for dt in steps:
        if todo and reference.waiting is None:
            assert isinstance(offer(reference, todo[0]), Admission)
            todo.pop(0)
        over = reference.advance(dt)
        time += dt
        if over is not None:
            ended.append(over.segment.stamp_ns)
        rows.append((time, dt, *reference.position, *reference.velocity))
    return np.array(rows), ended


def at(x=0.0, y=0.0, z=0.0):
    return Reference(np.array((x, y, z)), LIMITS)


@settings(max_examples=10)
@given(st.sampled_from([0.1, 0.15, 0.2]), st.integers(0, 1000))
def test_a_chain_is_continuous_in_position_and_velocity(speed, seed):
    segments = chain(LOOP, speed, duration=0.8)
    reference = at()
    total = sum(segment.duration for segment in segments)
    rng = np.random.default_rng(seed)
    steps = rng.uniform(0.001, 0.008, int(total / 0.0045) + 50).tolist()
    rows, ended = run(reference, segments, steps)
    assert ended == [segment.stamp_ns for segment in segments[: len(ended)]]
    assert len(ended) >= len(segments) - 1
    jumps = np.hypot(*np.diff(rows[:, 5:7], axis=0).T)
    assert np.all(jumps <= PARAMETERS.gate.acceleration_limit * rows[1:, 1])
    moves = np.diff(rows[:, 2:4], axis=0) - 0.5 * rows[1:, 1:2] * (rows[1:, 5:7] + rows[:-1, 5:7])
    assert np.abs(moves).max() < 1e-5


def test_no_time_is_lost_where_segments_join():
    segments = chain(LOOP, 0.1, duration=0.7)
    total = sum(segment.duration for segment in segments)
    rows, ended = run(at(), segments, [DT] * int(total / DT + 3))
    assert len(ended) == len(segments)
    moving = np.hypot(rows[:, 5], rows[:, 6]) > 0.0
    assert rows[moving, 0].max() == pytest.approx(total, abs=1.01 * DT)


@settings(max_examples=25)
@given(st.floats(0.05, 0.24), st.floats(0.002, 0.02), st.integers(0, 2))
def test_without_a_successor_it_comes_to_rest_at_the_end_of_the_path(speed, dt, number):
    segments = chain(LOOP, speed, duration=0.9)[: number + 1]
    reference = at()
    total = sum(segment.duration for segment in segments)
    rows, ended = run(reference, segments, [dt] * int((total + 0.3) / dt))
    assert len(ended) == len(segments)
    assert reference.soft_stops == 1
    np.testing.assert_allclose(reference.position[:2], segments[-1].positions[-1], atol=1e-12)
    assert not reference.velocity.any()
    knots = np.concatenate([segment.positions for segment in segments])
    share = np.linspace(0.0, 1.0, 20)[:, None, None]
    plan = (knots[:-1] + share * (knots[1:] - knots[:-1])).reshape(-1, 2)
    near_end = rows[rows[:, 0] > total - 0.2]
    distance = np.hypot(near_end[:, 2:3] - plan[:, 0], near_end[:, 3:4] - plan[:, 1]).min(axis=1)
    assert distance.max() < 5e-4


@pytest.mark.parametrize('speed', [0.05, 0.1, 0.2, 0.25])
def test_a_soft_stop_keeps_the_deceleration_limit(speed):
    moving = line((0.0, 0.0), (0.2, 0.0), speed * 0.999, stop=False)
    rows, _ = run(at(), [moving], [DT] * 1500)
    slowing = -np.diff(rows[:, 5]) / DT
    assert slowing.max() <= LIMITS.braking * (1.0 + 1e-6)
    assert slowing.max() >= 0.7 * LIMITS.braking
    assert rows[:, 2].max() <= 0.2 + 1e-12


def test_a_successor_after_braking_has_begun_is_late_and_changes_nothing():
    first, second = chain([(0.0, 0.0), (0.2, 0.0)], 0.1, duration=1.0)[:2]
    reference = at()
    offer(reference, first)
    while not reference.join()[1]:
        reference.advance(DT)
    left = float(first.positions[-1, 0] - reference.position[0])
    assert 0.0 < left <= 0.1**2 / (2.0 * LIMITS.braking) + 0.1 * DT
    assert offer(reference, second) is Refusal.LATE
    assert reference.waiting is None


def test_a_successor_from_rest_waits_for_standstill():
    first = chain([(0.0, 0.0), (0.2, 0.0)], 0.1, duration=1.0)[0]
    reference = at()
    offer(reference, first)
    while not reference.join()[1]:
        reference.advance(DT)
    x = float(first.positions[-1, 0])
    onward = line((x, 0.0), (x, 0.1), 0.1, stamp_ns=9 * MS)
    assert isinstance(offer(reference, onward), Admission)
    rows, ended = run(reference, [], [DT] * 800)
    assert ended == [first.stamp_ns, onward.stamp_ns]
    np.testing.assert_allclose(reference.position[:2], (x, 0.1), atol=1e-12)
    assert np.abs(np.diff(rows[:, 5:7], axis=0)).max() <= LIMITS.braking * DT * (1 + 1e-6)


def test_a_planned_stop_is_no_soft_stop():
    reference = at()
    _, ended = run(reference, [line((0.0, 0.0), (0.1, 0.0), 0.1)], [DT] * 500)
    assert ended == [MS]
    assert reference.soft_stops == 0
    assert reference.at_rest


@settings(max_examples=30)
@given(st.integers(5, 300), st.integers(1, 200))
def test_a_pause_stops_on_the_path_within_the_limit_and_goes_on(before, during):
    segments = chain([(0.0, 0.0), (0.2, 0.0)], 0.2, duration=10.0)
    reference = at()
    rows = [run(reference, segments, [DT] * before)[0]]
    reference.paused = True
    rows.append(run(reference, [], [DT] * (during + 50))[0])
    assert reference.at_rest
    reference.paused = False
    rows.append(run(reference, [], [DT] * 600)[0])
    speed = np.concatenate(rows)[:, 5]
    planned = 0.2 * 1.5 / RAMP
    assert -np.diff(speed).min() <= (LIMITS.braking + planned) * DT
    assert np.all(speed >= -1e-12)
    np.testing.assert_allclose(reference.position[:2], (0.2, 0.0), atol=1e-12)


def test_freezing_holds_a_point_and_drops_everything():
    segments = chain([(0.0, 0.0), (0.2, 0.0)], 0.1, duration=0.8)
    reference = at()
    run(reference, segments[:2], [DT] * 60)
    running, waiting = reference.freeze(0.05, 0.01)
    assert (running.segment, waiting.segment) == tuple(segments[:2])
    assert reference.join() == (PathState(0.05, 0.01), False)
    rows, _ = run(reference, [], [DT] * 10)
    assert np.ptp(rows[:, 2:], axis=0).max() == 0.0


@pytest.mark.parametrize('height', [0.03, -0.08, 0.0])
def test_the_height_is_approached_gently(height):
    reference = at(z=height)
    assert reference.position[2] == height
    rows, _ = run(reference, [line((0.0, 0.0), (0.1, 0.0), 0.1)], [DT] * 3000)
    assert reference.position[2] == 0.0
    assert np.abs(rows[:, 7]).max() <= LIMITS.height_speed * 1.001
    np.testing.assert_allclose(np.diff(rows[:, 4]), rows[1:, 7] * DT, atol=2e-6)
