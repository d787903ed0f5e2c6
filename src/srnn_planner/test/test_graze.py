# SPDX-License-Identifier: Apache-2.0
"""What is blocked, and how much of it a path meets."""

import numpy as np
import pytest

from srnn_planner.core.blockage import Blockage
from srnn_planner.core.graze import graze
from srnn_planner.core.grid_mean import GridMean
from srnn_planner.core.neighbourhood import Neighbourhood
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses

NEURONS = StateNeurons(NetworkParameters())
MEAN = GridMean(NetworkParameters())
PRIOR = NEURONS.prior_weights
FREE = np.zeros(len(NEURONS.positions))
NEIGHBOURHOOD = Neighbourhood(NEURONS)
BLOCKAGE = Blockage(NEIGHBOURHOOD, FREE)
EVERYWHERE = np.ones_like(FREE)


def straight(start, end, steps=20):
    return np.linspace(start, end, steps)


def test_where_all_is_free_nothing_is_grazed():
    paths = np.array([straight((-0.5, 0.0), (0.5, 0.3)), straight((0.0, 0.0), (0.0, 0.0))])
    assert not graze(paths, MEAN, FREE, 0.3).any()


def test_in_even_blockage_its_root_times_length_and_caution_count():
    paths = np.array([straight((-0.5, 0.0), (0.1, 0.0)), straight((0.1, 0.0), (0.1, 0.0))])
    assert graze(paths, MEAN, 0.25 * EVERYWHERE, 0.3) == pytest.approx([0.45, 0.15])


def test_what_is_met_is_the_root_of_the_blockage_along_the_path(rng):
    paths = np.cumsum(rng.normal(0.0, 0.05, (6, 15, 2)), axis=1)
    blockage = np.where(rng.random(len(FREE)) < 0.5, rng.random(len(FREE)), 0.0)
    met = np.sqrt(NEURONS.interpolate(blockage, paths.reshape(-1, 2))).reshape(6, 15)
    travelled = np.linalg.norm(np.diff(paths, axis=1), axis=2)
    expected = (travelled * met[:, 1:]).sum(axis=1) + 0.4 * met.max(axis=1)
    assert graze(paths, MEAN, blockage, 0.4) == pytest.approx(expected, rel=1e-6)


def test_round_a_blocked_place_nothing_is_met_and_through_it_most():
    blockage = np.exp(-0.5 * (NEURONS.positions**2).sum(axis=1) / 0.15**2)
    through = straight((-0.8, 0.0), (0.8, 0.0), 21)
    bend = np.column_stack([np.zeros(21), np.sin(np.linspace(0.0, np.pi, 21))])
    paths = through + np.array([0.0, 0.3, 0.9])[:, None, None] * bend
    centre, edge, clear = graze(paths, MEAN, blockage**2, 0.2)
    assert centre > 2.0 * edge > 20.0 * clear


def test_blockage_is_the_root_mean_square_loss_of_what_excited_a_neuron():
    weights = PRIOR.copy()
    neuron = 112
    excited = (PRIOR[:, neuron] > 0.0) & (np.arange(len(PRIOR)) != neuron)
    weights[:, neuron] = np.where(excited, PRIOR[:, neuron] - 0.4, -1.0)
    found = BLOCKAGE.of(Synapses.of(NEURONS.prior, weights))
    assert found[neuron] == pytest.approx(0.4, rel=1e-5)
    assert not np.delete(found, neuron).any()
    weights[:, neuron] = PRIOR[:, neuron]
    one = int(np.flatnonzero(excited)[0])
    weights[one, neuron] -= 0.5
    found = BLOCKAGE.of(Synapses.of(NEURONS.prior, weights))
    assert found[neuron] == pytest.approx(0.5 / np.sqrt(excited.sum()), rel=1e-5)
    # What has become more excitatory cannot make up for what is lost.
    assert not BLOCKAGE.of(Synapses.of(NEURONS.prior, np.minimum(PRIOR + 0.2, 1.0))).any()


def test_known_obstacles_block_without_a_touch_and_up_to_a_limit():
    inhibition = FREE.copy()
    inhibition[[5, 7]] = -0.5, -9.0
    found = Blockage(NEIGHBOURHOOD, inhibition).of(Synapses(NEURONS.prior))
    assert found[[5, 6, 7]] == pytest.approx([0.5, 0.0, 2.0])


def test_a_neuron_between_two_blocked_ones_is_in_a_blocked_neighbourhood():
    blockage = FREE.copy()
    blockage[[111, 113]] = 1.0
    around = BLOCKAGE.around(blockage)
    assert around[112] > 0.0
    assert around[112] == pytest.approx(2.0 / NEIGHBOURHOOD.count[112])


@pytest.mark.parametrize(('dimensions', 'side'), [(1, 15), (2, 15), (3, 6)])
def test_interpolation_is_the_mean_by_responsibilities(dimensions, side):
    neurons = StateNeurons(
        NetworkParameters(dimensions=dimensions, neurons_per_dimension=side, sigma=0.15)
    )
    rng = np.random.default_rng(dimensions)
    points = rng.uniform(-1.2, 1.2, (50, dimensions))
    values = rng.standard_normal(side**dimensions)
    expected = neurons.responsibilities(points) @ values
    assert neurons.interpolate(values, points) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(('dimensions', 'side'), [(1, 15), (1, 3), (2, 15), (2, 60), (3, 6)])
def test_compiled_interpolation_leaves_out_only_what_does_not_count(dimensions, side):
    network = NetworkParameters(dimensions=dimensions, neurons_per_dimension=side, sigma=0.11)
    neurons, rng = StateNeurons(network), np.random.default_rng(dimensions)
    points = rng.uniform(-1.3, 1.3, (200, dimensions))
    everywhere = rng.standard_normal(side**dimensions)
    here_and_there = np.where(rng.random(side**dimensions) < 0.03, everywhere, 0.0)
    for values in (everywhere, here_and_there, np.zeros_like(everywhere)):
        expected = neurons.interpolate(values, points)
        assert GridMean(network).at(values, points) == pytest.approx(expected, abs=1e-6)
