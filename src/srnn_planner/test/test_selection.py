# SPDX-License-Identifier: Apache-2.0
"""Sample rejection: one movement is averaged, never two ways round an obstacle."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_config import ParameterError
from srnn_planner.core.nearest_directions import nearest_directions
from srnn_planner.core.parameters import SelectionParameters
from srnn_planner.core.selection import (
    Cost,
    best_mode,
    mode_seeking,
    pairwise_angles,
    select,
    three_sigma,
)


def fan(angles, length=1.0):
    angles = np.asarray(angles)
    return length * np.column_stack([np.cos(angles), np.sin(angles)])


def test_three_sigma_rejects_the_outlier_and_keeps_the_rest(rng):
    angles = np.concatenate([rng.normal(0.0, 0.1, 38), [3.0, -2.8]])
    kept = three_sigma(fan(angles), 0.9)
    assert kept[:38].sum() >= 35
    assert not kept[38:].any()


def test_mode_seeking_takes_one_of_two_ways_round(rng):
    angles = np.concatenate([rng.normal(0.8, 0.1, 22), rng.normal(-0.8, 0.1, 18)])
    kept = mode_seeking(fan(angles), 0.35)
    assert kept.sum() == 14
    assert kept[:22].all() != kept[22:].any() or kept[:22].sum() in (0, 14)


def test_three_sigma_averages_over_both_ways_where_mode_seeking_does_not(rng):
    """The reason for the second rule: a broad two-sided fan keeps both sides."""
    angles = np.concatenate([rng.normal(0.8, 0.5, 20), rng.normal(-0.8, 0.5, 20)])
    displacement = fan(angles)
    both = angles[three_sigma(displacement, 0.9)]
    assert (both > 0.3).any()
    assert (both < -0.3).any()
    assert np.ptp(angles[mode_seeking(displacement, 0.2)]) < 0.6


def test_mode_seeking_is_not_drawn_to_samples_that_hardly_move(rng):
    """As before a wall: many small steps in all directions, some long ones along it."""
    idle = fan(rng.uniform(-np.pi, np.pi, 24), length=0.02)
    onward = fan(rng.normal(1.2, 0.05, 16), length=0.3)
    displacement = np.vstack([idle, onward])
    kept = mode_seeking(displacement, 0.2)
    assert np.linalg.norm(displacement[kept].mean(axis=0)) > 0.2


def straight_paths(angles, length=0.3, steps=10):
    return np.linspace(0.0, 1.0, steps)[None, :, None] * fan(angles, length)[:, None]


def nothing(paths):
    return np.zeros(len(paths))


HEIGHT_LOST = Cost(lambda paths: -paths[:, -1, 1], nothing)
"""A cost that falls towards positive y."""


def test_the_best_mode_is_the_one_whose_mean_costs_least_not_the_densest(rng):
    up, down = rng.normal(np.pi / 2, 0.1, 8), rng.normal(-np.pi / 2, 0.02, 32)
    kept = best_mode(straight_paths(np.concatenate([down, up])), 0.2, HEIGHT_LOST)
    assert kept.sum() == 8
    assert kept[32:].all()


def test_what_is_judged_is_the_mean_of_a_mode_and_no_other_mode_costs_less(rng):
    """Two ways round: a mode of both would lead in between, where it costs most."""
    angles = np.concatenate([rng.normal(0.6, 0.05, 4), rng.normal(-0.6, 0.05, 4)])
    paths = straight_paths(angles)

    def cost(candidates):
        return np.exp(-((candidates[:, -1, 1] / 0.05) ** 2))

    kept = best_mode(paths, 0.5, Cost(nothing, cost))
    assert kept[:4].all() != kept[4:].all()
    chosen = cost(paths[kept].mean(axis=0)[None])[0]
    for reference in range(8):
        near = np.argsort(np.abs(angles - angles[reference]))[:4]
        assert chosen <= cost(paths[near].mean(axis=0)[None])[0] + 1e-12


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 40), steepness=st.floats(0.0, 3.0))
def test_modes_that_are_not_judged_do_not_cost_less(seed, count, steepness):
    """Whatever share of the cost is found out later, the mode is that of the whole cost."""
    rng = np.random.default_rng(seed)
    paths = rng.normal(size=(count, 5, 2)).round(1)

    def least(candidates):
        return candidates[:, -1, 0].round(1)

    def more(candidates):
        return steepness * np.abs(candidates[:, :, 1]).max(axis=1).round(1)

    def whole(candidates):
        return least(candidates) + more(candidates)

    judged = best_mode(paths, 0.1, Cost(least, more))
    assert np.array_equal(judged, best_mode(paths, 0.1, Cost(whole, nothing)))


@given(seed=st.integers(0, 2**32 - 1))
def test_selection_does_not_depend_on_the_order_of_samples(seed):
    rng = np.random.default_rng(seed)
    displacement = rng.normal(size=(30, 2))
    order = rng.permutation(30)
    for rule in (lambda d: three_sigma(d, 0.9), lambda d: mode_seeking(d, 0.3)):
        assert np.array_equal(rule(displacement)[order], rule(displacement[order]))


@given(seed=st.integers(0, 2**32 - 1), dimensions=st.integers(1, 4))
def test_angles_are_symmetric_and_zero_to_themselves(seed, dimensions):
    angle = pairwise_angles(np.random.default_rng(seed).normal(size=(12, dimensions)))
    assert np.allclose(angle, angle.T)
    assert (np.diag(angle) == 0.0).all()
    assert angle.max() <= np.pi


@given(
    seed=st.integers(0, 2**32 - 1), samples=st.integers(1, 30), dimensions=st.integers(1, 3),
    share=st.floats(0.0, 1.0),
)  # fmt: skip
def test_nearest_directions_are_those_of_the_smallest_angles(seed, samples, dimensions, share):
    displacement = np.random.default_rng(seed).normal(size=(samples, dimensions))
    count = max(1, round(share * samples))
    angle = pairwise_angles(displacement)
    nearest = nearest_directions(displacement, count)
    assert (nearest[:, 0] == np.arange(samples)).all()
    assert all(len(set(row)) == count for row in nearest.tolist())
    found = np.take_along_axis(angle, nearest, axis=1)
    assert found == pytest.approx(np.sort(angle, axis=1)[:, :count], abs=1e-7)


def test_at_least_one_sample_is_always_kept():
    paths = np.zeros((1, 5, 2))
    for rule in ('three_sigma', 'mode_seeking', 'best_mode'):
        assert select(paths, SelectionParameters(rule=rule), Cost(nothing, nothing)).all()


def test_unknown_rule_is_refused_naming_the_rules():
    with pytest.raises(ParameterError, match='three_sigma, mode_seeking, best_mode'):
        SelectionParameters(rule='median')
