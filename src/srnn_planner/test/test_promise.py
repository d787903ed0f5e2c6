# SPDX-License-Identifier: Apache-2.0
"""Which samples lead on, and what is blocked."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_planner.core.blockage import Blockage
from srnn_planner.core.parameters import NetworkParameters, SelectionParameters
from srnn_planner.core.promise import expected_cost, promising
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.ways import Ways

NEURONS = StateNeurons(NetworkParameters())
PRIOR = NEURONS.prior_weights
FREE = np.zeros(len(NEURONS.positions))
TARGET = np.array([0.6, 0.0])
REMAINING = Ways(NEURONS, FREE).remaining(PRIOR, TARGET, 10.0)


def straight(start, end, steps=20):
    return np.linspace(start, end, steps)


def cost(paths, blockage=FREE, aversion=10.0, caution=0.2):
    return expected_cost(np.array(paths), NEURONS, REMAINING, blockage, aversion, caution)


def test_where_all_is_free_the_cost_is_the_way_that_remains():
    paths = [straight((-0.5, 0.0), (0.0, 0.0)), straight((-0.5, 0.0), (-0.5, 0.4))]
    ends = np.array([path[-1] for path in paths])
    assert cost(paths) == pytest.approx(NEURONS.interpolate(REMAINING, ends))
    assert cost(paths)[0] < cost(paths)[1]


def test_a_way_through_blockage_costs_its_length_and_the_worst_of_it():
    everywhere = np.full_like(FREE, 0.5)
    path = straight((-0.5, 0.0), (0.1, 0.0))
    extra = cost([path], everywhere, aversion=8.0, caution=0.3) - cost([path])
    assert extra == pytest.approx(8.0 * (0.6 * 0.5 + 0.3 * 0.5))


def test_round_a_blocked_place_is_better_than_through_it_and_than_staying_before_it():
    blockage = np.exp(-0.5 * (NEURONS.positions**2).sum(axis=1) / 0.15**2)
    through = straight((-0.6, 0.0), (0.5, 0.0), 21)
    bend = 0.6 * np.sin(np.linspace(0.0, np.pi, 21))
    around = through + np.column_stack([np.zeros(21), bend])
    stay = np.repeat([[-0.6, 0.0]], 21, axis=0)
    costs = cost([around, through, stay], blockage)
    assert costs[0] < costs[2] < costs[1]


@given(
    costs=st.lists(st.floats(-5.0, 5.0), min_size=1, max_size=60),
    share=st.floats(0.01, 1.0),
)
def test_the_cheapest_share_is_kept_ties_and_all(costs, share):
    costs = np.array(costs)
    kept = promising(costs, replace(SelectionParameters(), promising=share))
    assert kept.sum() >= max(1, round(share * len(costs)))
    assert costs[kept].max() < min(costs[~kept], default=np.inf)
    assert len(np.unique(costs)) < len(costs) or kept.sum() == max(1, round(share * len(costs)))


def test_the_whole_population_is_kept_by_the_share_of_the_paper():
    assert promising(np.arange(40.0), replace(SelectionParameters(), promising=1.0)).all()


def test_blockage_is_the_root_mean_square_loss_of_what_excited_a_neuron():
    weights = PRIOR.copy()
    neuron = 112
    excited = (PRIOR[:, neuron] > 0.0) & (np.arange(len(PRIOR)) != neuron)
    weights[:, neuron] = np.where(excited, PRIOR[:, neuron] - 0.4, -1.0)
    found = Blockage(NEURONS, FREE).of(weights)
    assert found[neuron] == pytest.approx(0.4, rel=1e-5)
    assert not np.delete(found, neuron).any()
    weights[:, neuron] = PRIOR[:, neuron]
    one = int(np.flatnonzero(excited)[0])
    weights[one, neuron] -= 0.5
    found = Blockage(NEURONS, FREE).of(weights)
    assert found[neuron] == pytest.approx(0.5 / np.sqrt(excited.sum()), rel=1e-5)
    # What has become more excitatory cannot make up for what is lost.
    assert not Blockage(NEURONS, FREE).of(np.minimum(PRIOR + 0.2, 1.0)).any()


def test_known_obstacles_block_without_a_touch_and_up_to_a_limit():
    inhibition = FREE.copy()
    inhibition[[5, 7]] = -0.5, -9.0
    found = Blockage(NEURONS, inhibition).of(PRIOR)
    assert found[[5, 6, 7]] == pytest.approx([0.5, 0.0, 2.0])


def test_a_neuron_between_two_blocked_ones_is_in_a_blocked_neighbourhood():
    belief = Blockage(NEURONS, FREE)
    blockage = FREE.copy()
    blockage[[111, 113]] = 1.0
    around = belief.around(blockage)
    assert around[112] > 0.0
    assert around[112] == pytest.approx(2.0 / belief.neighbours[:, 112].sum())


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
