# SPDX-License-Identifier: Apache-2.0
"""Segments in time: exact joints, consistent derivatives, limits, closed-form durations."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_planner.core.arc_length import evenly
from srnn_planner.core.curve import fit
from srnn_planner.core.parameters import TrajectoryParameters
from srnn_planner.core.retreat import Trail, at_rest, back_off
from srnn_planner.core.trajectory import Motion, join, time_path

P = TrajectoryParameters()
SEEDS = st.integers(0, 2**32 - 1)


def random_path(rng, steps=30, noise=0.001):
    angle = rng.uniform(0, 2 * np.pi) + np.cumsum(rng.normal(0, 0.08, steps))
    steps_ = rng.uniform(0.002, 0.005, steps)[:, None]
    path = np.cumsum(steps_ * np.column_stack([np.cos(angle), np.sin(angle)]), axis=0)
    return path + rng.normal(0, noise, path.shape)


def random_segment(seed):
    rng = np.random.default_rng(seed)
    start = Motion(rng.normal(0, 0.005, 2), rng.uniform(-0.07, 0.07, 2))
    return start, time_path(random_path(rng), start, 0.1, P)


@given(seed=SEEDS, dimensions=st.integers(1, 3))
def test_points_at_even_distances_are_those_of_a_line_through_many_points(seed, dimensions):
    coefficients = np.random.default_rng(seed).normal(size=(6, dimensions))
    points, length = evenly(coefficients, 25)
    line = np.polynomial.polynomial.polyval(np.linspace(0.0, 1.0, 100), coefficients).T
    distance = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    assert length == pytest.approx(distance[-1])
    even = np.linspace(0.0, length, 25)
    for d in range(dimensions):
        expected = np.interp(even, distance, line[:, d])
        assert points[:, d] == pytest.approx(expected, abs=1e-9)


def test_a_path_without_length_stays_where_it_is():
    points, length = evenly(np.array([[0.3, -0.2], [0.0, 0.0]]), 7)
    assert length == 0.0
    assert (points == [0.3, -0.2]).all()


@given(seed=SEEDS)
def test_segment_starts_in_the_state_it_joins(seed):
    start, segment = random_segment(seed)
    assert segment is not None
    assert segment.positions[0] == pytest.approx(start.position, abs=1e-12)
    assert segment.velocities[0] == pytest.approx(start.velocity, abs=1e-9)


@given(seed=SEEDS)
def test_segment_keeps_the_acceleration_limit(seed):
    _, segment = random_segment(seed)
    assert np.linalg.norm(segment.accelerations, axis=1).max() <= P.acceleration_max


@given(seed=SEEDS)
def test_velocities_and_accelerations_are_the_derivatives(seed):
    """Hermite's rule over one knot interval; the remainder is of third order."""
    _, segment = random_segment(seed)
    dt = np.diff(segment.times)[:, None]
    v, a = segment.velocities, segment.accelerations
    step = np.diff(segment.positions, axis=0)
    predicted = dt * (v[1:] + v[:-1]) / 2 - dt**2 * (a[1:] - a[:-1]) / 12
    assert np.abs(step - predicted).max() < 3e-4


def test_straight_path_from_rest_takes_length_over_velocity_plus_ramp():
    path = np.linspace([0.0, 0.0], [0.1, 0.0], 30)
    segment = time_path(path, at_rest(path[0]), 0.1, P)
    ramp = 0.1 / P.acceleration
    assert segment.duration == pytest.approx(0.1 / 0.1 + ramp / 2, rel=1e-3)
    assert segment.velocities[-1] == pytest.approx([0.1, 0.0], abs=1e-3)


def test_straight_path_at_speed_takes_length_over_velocity():
    path = np.linspace([0.0, 0.0], [0.1, 0.0], 30)
    segment = time_path(path, Motion(path[0], np.array([0.1, 0.0])), 0.1, P)
    assert segment.duration == pytest.approx(1.0, rel=1e-3)


def test_turning_back_at_once_is_possible_within_the_limit():
    path = np.linspace([0.0, 0.0], [-0.02, 0.0], 30)
    segment = time_path(path, Motion(path[0], np.array([0.1, 0.0])), 0.1, P)
    assert segment is not None
    assert segment.positions[-1, 0] < 0.0


def test_short_path_lasts_the_shortest_duration():
    path = np.linspace([0.0, 0.0], [0.001, 0.0], 30)
    segment = time_path(path, at_rest(path[0]), 0.1, P)
    assert segment.duration >= 0.99 * P.duration_min


def test_join_moves_the_start_and_leaves_the_end():
    path = np.linspace([0.0, 0.0], [0.1, 0.0], 40)
    joined = join(path, np.array([0.0, 0.01]), 4.0)
    assert joined[0] == pytest.approx([0.0, 0.01])
    assert joined[-1] == pytest.approx(path[-1], abs=1e-5)


@given(seed=SEEDS)
def test_curve_has_even_speed_and_starts_at_the_first_point(seed):
    path = random_path(np.random.default_rng(seed))
    curve = fit(path)
    speed = np.linalg.norm(curve.at(np.linspace(0, 1, 50))[1], axis=1)
    assert curve.at(np.zeros(1))[0][0] == pytest.approx(path[0], abs=1e-12)
    assert speed == pytest.approx(np.full(50, curve.length), rel=0.35)


def test_derivatives_of_the_curve_are_its_finite_differences():
    curve, s, step = fit(random_path(np.random.default_rng(1))), np.linspace(0.1, 0.9, 9), 1e-4
    before, here, after = (curve.at(s + d * step) for d in (-1, 0, 1))
    assert here[1] == pytest.approx((after[0] - before[0]) / (2 * step), rel=1e-5, abs=1e-7)
    assert here[2] == pytest.approx((after[1] - before[1]) / (2 * step), rel=1e-5, abs=1e-7)


def test_curve_through_a_circle_arc_stays_on_it():
    angle = np.linspace(0.0, 1.5, 40)
    arc = np.column_stack([np.cos(angle), np.sin(angle)])
    radius = np.linalg.norm(fit(arc).at(np.linspace(0, 1, 100))[0], axis=1)
    assert radius == pytest.approx(np.ones(100), abs=0.02)


def test_back_off_goes_from_rest_to_rest_and_then_on():
    onward = time_path(np.linspace([0.0, 0.0], [0.05, 0.0], 30), at_rest(np.zeros(2)), 0.1, P)
    contact = np.array([0.0, 0.018])
    segment = back_off(contact, onward, P.acceleration)
    turn = int(np.argmin(np.abs(segment.times - (segment.duration - onward.duration))))
    assert segment.positions[0] == pytest.approx(contact)
    assert segment.velocities[0] == pytest.approx(np.zeros(2))
    assert segment.positions[turn] == pytest.approx(np.zeros(2), abs=1e-12)
    assert segment.velocities[turn] == pytest.approx(np.zeros(2))
    assert (np.diff(segment.times) > 0).all()
    speed = np.linalg.norm(segment.velocities[: turn + 1], axis=1).max()
    assert speed <= np.sqrt(0.018 * P.acceleration) + 1e-9


def test_trail_goes_back_as_the_crow_flies():
    trail = Trail(points=100)
    to_and_fro = np.concatenate([np.linspace(0, 0.05, 30), np.linspace(0.05, 0.04, 10)] * 2)
    trail.extend(np.column_stack([to_and_fro, np.zeros(80)]))
    point = trail.back(0.02)
    assert abs(point[0] - to_and_fro[-1]) >= 0.02


def test_trail_that_is_too_short_gives_its_farthest_point():
    trail = Trail()
    with pytest.raises(ValueError, match='no path'):
        trail.back(0.01)
    trail.extend(np.array([[0.0, 0.0], [0.001, 0.0], [0.002, 0.0]]))
    assert trail.back(0.1) == pytest.approx([0.0, 0.0])


@given(seed=SEEDS)
def test_any_path_can_be_joined_from_any_motion(seed):
    """Folded, noisy, tiny and far-away paths alike: an arm on the move must get a segment."""
    rng = np.random.default_rng(seed)
    angle = rng.uniform(0, 2 * np.pi) + np.cumsum(rng.normal(0, 0.6, 40))
    step = rng.choice([0.0001, 0.001, 0.003])
    path = np.cumsum(step * np.column_stack([np.cos(angle), np.sin(angle)]), axis=0)
    path += rng.normal(0, 0.02, 2)
    start = Motion(np.zeros(2), rng.uniform(-0.1, 0.1, 2))
    segment = time_path(path, start, 0.1, P)
    assert segment is not None
    assert np.linalg.norm(segment.accelerations, axis=1).max() <= P.acceleration_max
