# SPDX-License-Identifier: Apache-2.0
"""The field of a way point follows what was learned, and nothing else."""

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_config.scene import Obstacle
from srnn_planner.core.known_obstacles import obstacle_input
from srnn_planner.core.parameters import NetworkParameters, ObstacleParameters
from srnn_planner.core.shortest_way import distances, relaxed
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses
from srnn_planner.core.ways import Ways

NEURONS = StateNeurons(NetworkParameters())
PRIOR = NEURONS.prior_weights
FREE = np.zeros(len(NEURONS.positions))
TARGET = np.array([0.8, 0.0])


def blocked_column(x=0.0, reach=0.5):
    """Weights in which none excites the three columns of neurons at x, up to |y| = reach."""
    weights = PRIOR.copy()
    wall = (np.abs(NEURONS.positions[:, 0] - x) < 0.2) & (
        np.abs(NEURONS.positions[:, 1]) < reach
    )
    weights[:, wall] = -1.0
    return weights


def at(x, y):
    return int(np.argmin(np.linalg.norm(NEURONS.positions - [x, y], axis=1)))


def detour(weights, aversion, target=TARGET, inhibition=FREE):
    ways = Ways(NEURONS, inhibition)
    return ways.detour(remaining(ways, weights, aversion, target), target)


def remaining(ways, weights, aversion, target=TARGET):
    synapses = Synapses.of(NEURONS.prior, weights)
    tolls = ways.tolls(synapses, ways.blockage.of(synapses), aversion)
    return ways.remaining(tolls, target, FREE)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), aversion=st.floats(0.1, 50.0))
def test_detours_are_never_negative_and_grow_with_aversion(seed, aversion):
    rng = np.random.default_rng(seed)
    weights = np.clip(PRIOR - rng.exponential(0.2, PRIOR.shape), -1.0, 1.0).astype(np.float32)
    target = rng.uniform(-0.9, 0.9, 2)
    less, more = (detour(weights, a, target) for a in (aversion, 2.0 * aversion))
    assert (less >= 0.0).all()
    assert (more >= less - 1e-12).all()


def test_nothing_learned_means_no_detour_and_hardly_more_than_the_beeline():
    assert not detour(PRIOR, 5.0).any()
    ways = Ways(NEURONS, FREE)
    found = remaining(ways, PRIOR, 5.0)
    beeline = np.linalg.norm(NEURONS.positions - TARGET, axis=1)
    assert (found >= beeline - 1e-12).all()
    # Steps reach up to two neurons far, in 16 directions.
    assert (found <= 1.05 * beeline + 0.02).all()


def test_without_aversion_nothing_is_a_detour():
    assert not detour(blocked_column(), 0.0).any()


def test_behind_a_wall_the_way_is_longer_before_it_not():
    found = detour(blocked_column(), 20.0)
    assert found[at(-0.3, 0.0)] > 0.3
    assert found[at(0.7, 0.0)] == pytest.approx(0.0, abs=1e-9)
    assert found[at(-0.3, 0.0)] > found[at(-0.3, 0.6)]


def test_no_way_is_longer_than_well_round_the_wall():
    """Beyond the reach of the blocked neurons nothing was lost, whatever the aversion."""
    found = detour(blocked_column(), 1000.0)
    corners = np.array([[-0.8, 0.0], [-0.6, 1.0], [0.6, 1.0], TARGET])
    round_it = np.linalg.norm(np.diff(corners, axis=0), axis=1).sum()
    assert found[at(-0.8, 0.0)] < 1.05 * round_it - 1.6


def test_a_gap_too_narrow_for_the_bump_of_activity_is_no_short_cut():
    wall = blocked_column(reach=0.6)
    gap = wall.copy()
    free = np.abs(NEURONS.positions[:, 1]) < 0.05
    gap[:, free] = PRIOR[:, free]
    through, none = (detour(w, 20.0)[at(-0.3, 0.0)] for w in (gap, PRIOR))
    assert none == 0.0
    assert through > 0.5 * detour(wall, 20.0)[at(-0.3, 0.0)]


def test_a_known_obstacle_is_a_detour_without_any_touch():
    box = Obstacle('box', (0.0, 0.0), size=(0.03, 0.24))
    inhibition = obstacle_input(0.3 * NEURONS.positions, [box], ObstacleParameters())
    assert detour(PRIOR, 20.0, inhibition=inhibition)[at(-0.3, 0.0)] > 0.2


def test_known_obstacles_inhibit_what_is_near_and_nothing_far_away():
    disc = Obstacle('disc', (0.1, 0.0), radius=0.03)
    p = ObstacleParameters(strength=4.0, margin=0.01, falloff=0.01)
    points = np.array([[0.1, 0.0], [0.135, 0.0], [0.15, 0.0], [-0.2, 0.0]])
    found = obstacle_input(points, [disc], p)
    assert found[:2] == pytest.approx([-4.0, -4.0])
    assert found[2] == pytest.approx(-4.0 * np.exp(-0.5))
    assert found[3] == pytest.approx(0.0, abs=1e-12)
    assert not obstacle_input(points, [], p).any()


@given(seed=st.integers(0, 2**32 - 1))
def test_shortest_ways_are_those_of_bellman_and_ford(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 9))
    pre, post = np.nonzero(rng.random((count, count)) < 0.4)
    order = np.argsort(post, kind='stable')
    pre, post = pre[order], post[order]
    length, tolls = rng.random((2, len(pre)))
    fatigue = rng.random(count)
    cost = length * (tolls + fatigue[pre])
    start = np.where(rng.random(count) < 0.4, rng.random(count), np.inf)
    expected = start.copy()
    for _ in range(count):
        for a, b, step in zip(pre, post, cost, strict=True):
            expected[a] = min(expected[a], step + expected[b])
    first = np.searchsorted(post, np.arange(count + 1))
    for way in (distances, relaxed):
        found = way(first, pre.astype(np.int32), length, tolls, fatigue, start)
        assert found == pytest.approx(expected)
