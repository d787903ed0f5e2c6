# SPDX-License-Identifier: Apache-2.0
"""The prior by offset, what was learned beside it, and both against all weights (K, K)."""

from dataclasses import replace

from dense_weights import every
from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_msgs_py.weights import LearnedWeights
from srnn_planner.core.errors import SrnnError, WeightsError
from srnn_planner.core.neighbourhood import Neighbourhood
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.prior import RESOLUTION, PriorWeights
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapse_spans import SpanMaker
from srnn_planner.core.synapses import Synapses

SEEDS = st.integers(0, 2**32 - 1)
NETWORKS = [
    NetworkParameters(neurons_per_dimension=7),
    NetworkParameters(),
    NetworkParameters(dimensions=1, neurons_per_dimension=40, sigma=0.04),
    NetworkParameters(dimensions=3, neurons_per_dimension=5, sigma=0.2, weight_gain=2.0),
    NetworkParameters(neurons_per_dimension=31, sigma=0.05),
    NetworkParameters(neurons_per_dimension=5, weight_gain=1e-9),
]
networks = st.sampled_from(NETWORKS)


def taught(network, rng, share=0.02):
    """Return synapses of which a share has learned, and all weights (K, K)."""
    prior = PriorWeights(network)
    weights = prior.dense()
    learned = rng.random(weights.shape) < share
    weights[learned] = rng.uniform(-1.0, 1.0, learned.sum())
    return Synapses.of(prior, weights), weights


@pytest.mark.parametrize('network', NETWORKS)
def test_the_prior_is_the_gaussian_of_the_distance_minus_the_offset(network):
    neurons = StateNeurons(network)
    gaussian = network.weight_gain * neurons.basis(neurons.positions)
    expected = np.clip(gaussian - network.weight_offset, -1.0, 1.0)
    assert neurons.prior.dense() == pytest.approx(expected, abs=1.01 * RESOLUTION)


@pytest.mark.parametrize('network', NETWORKS)
def test_offsets_are_those_of_all_synapses_that_are_not_at_rest(network):
    prior = PriorWeights(network)
    offsets, weights = prior.offsets()
    which, offset = prior.grid.pairs(np.arange(prior.grid.count), offsets)
    expected = np.full((prior.grid.count,) * 2, prior.rest)
    expected[which, which + (offsets @ prior.grid.strides)[offset]] = weights[offset]
    assert np.array_equal(prior.dense(), expected)
    assert (weights != prior.rest).all()


def test_priors_of_different_networks_have_different_checksums():
    changes = {
        'dimensions': 3, 'neurons_per_dimension': 17, 'sigma': 0.12, 'weight_gain': 81.0,
        'weight_offset': 0.36,
    }  # fmt: skip
    networks = [replace(NETWORKS[1], **{name: value}) for name, value in changes.items()]
    sums = {PriorWeights(network).checksum for network in (NETWORKS[1], *networks)}
    assert len(sums) == 1 + len(changes)
    others = replace(NETWORKS[1], tau=3, slope=1.0, threshold=2.0)
    assert PriorWeights(others).checksum == PriorWeights(NETWORKS[1]).checksum


@settings(max_examples=40)
@given(networks, SEEDS)
def test_what_was_learned_and_the_prior_are_all_weights(network, seed):
    rng = np.random.default_rng(seed)
    synapses, weights = taught(network, rng)
    assert np.array_equal(synapses.dense(), weights)
    assert np.array_equal(weights[synapses.pre, synapses.post], synapses.learned.values)
    asked = np.flatnonzero(rng.random(weights.size) < 0.1)
    assert np.array_equal(synapses.at(asked), weights.flat[asked])
    change = np.zeros(weights.shape)
    change[synapses.pre, synapses.post] = synapses.change
    assert np.array_equal(change, weights.astype(float) - synapses.prior.dense())
    assert synapses.change.all()


@settings(max_examples=40)
@given(networks, SEEDS)
def test_weights_between_some_neurons_are_read_and_written_as_a_block(network, seed):
    rng = np.random.default_rng(seed)
    synapses, weights = taught(network, rng)
    some = np.flatnonzero(rng.random(len(weights)) < 0.3)
    block = np.ix_(some, some)
    assert np.array_equal(synapses.among(some), weights[block])
    expected = weights.copy()
    changed = rng.random((len(some), len(some))) < 0.5
    # Half of them learn, the others forget.
    expected[block] = np.where(changed, -0.25, synapses.prior.dense()[block])
    after = synapses.with_among(some, expected[block])
    assert after.learned.same_as(Synapses.of(synapses.prior, expected).learned)
    assert np.array_equal(synapses.dense(), weights)


@settings(max_examples=40, deadline=None)
@given(networks, SEEDS)
def test_spans_are_the_weights_as_whole_numbers(network, seed):
    rng = np.random.default_rng(seed)
    maker = SpanMaker(PriorWeights(network), 5.0)
    # Whoever has made spans before makes the same ones.
    for share in (0.0, 0.3, 0.01):
        synapses, weights = taught(network, rng, share)
        spans = maker.of(synapses)
        expected = np.rint(weights * spans.scale).astype(np.int64)
        at_rest = np.abs(expected - spans.rest) <= 1
        assert np.array_equal(spans.dense(), np.where(at_rest, spans.rest, expected))
        assert np.abs(weights).sum(axis=0).max() * spans.scale < 2.0**29


@settings(max_examples=20, deadline=None)
@given(networks, SEEDS)
def test_neighbours_are_those_that_the_prior_lets_excite(network, seed):
    neurons, rng = StateNeurons(network), np.random.default_rng(seed)
    steps, count = Neighbourhood(neurons), network.neurons
    excites = (neurons.prior.dense() > 0.0) & ~np.eye(count, dtype=bool)
    post = np.repeat(np.arange(count), steps.count)
    found = np.zeros_like(excites)
    found[steps.pre, post] = True
    assert np.array_equal(found, excites)
    apart = neurons.positions[steps.pre] - neurons.positions[post]
    assert steps.length == pytest.approx(np.linalg.norm(apart, axis=1))
    pre, post = rng.integers(0, count, (2, 50))
    edge = steps.edges(pre, post)
    assert np.array_equal(edge >= 0, excites[pre, post])
    assert np.array_equal(steps.pre[edge[edge >= 0]], pre[edge >= 0])
    values = np.where(rng.random(count) < 0.3, rng.random(count), 0.0)
    expected = values @ excites / np.maximum(excites.sum(axis=0), 1)
    assert steps.mean(values) == pytest.approx(expected, abs=1e-12)


NEURONS = StateNeurons(NETWORKS[0])
PRIOR = NEURONS.prior.checksum
ONE = LearnedWeights(49, PRIOR, np.array([3, 9]), np.array([0.5, -0.5], np.float32))


@pytest.mark.parametrize(
    ('changes', 'complaint'),
    [
        ({'neurons': 50}, 'weights of 50 neurons: must be of 49'),
        ({'prior': PRIOR ^ 1}, 'beside the prior .* must be .* sigma, weight_gain'),
        ({'synapses': np.array([9, 3])}, 'must increase'),
        ({'synapses': np.array([3, 3])}, 'must increase'),
        ({'synapses': np.array([-1, 3])}, 'must increase'),
        ({'synapses': np.array([3, 49 * 49])}, 'synapse 2401: must be one of 0 to 2400'),
        ({'synapses': np.array([3])}, 'must be one for each'),
        ({'values': np.array([0.5, np.nan], np.float32)}, 'weight 1 = nan: must be finite'),
        ({'values': np.array([0.5, -1.5], np.float32)}, r'reach 1.5 .* must be in \[-1, 1\]'),
    ],
)
def test_weights_that_do_not_fit_are_refused(changes, complaint):
    assert len(NEURONS.synapses(ONE).learned) == 2
    with pytest.raises(WeightsError, match=complaint) as error:
        NEURONS.synapses(replace(ONE, **changes))
    assert isinstance(error.value, SrnnError)
    assert isinstance(error.value, ValueError)


def test_weights_are_the_same_to_the_last_bit_or_others():
    same = replace(ONE, synapses=ONE.synapses.astype(np.int32).astype(np.int64))
    assert ONE.same_as(same)
    for changes in (
        {'neurons': 50}, {'prior': PRIOR ^ 1}, {'synapses': ONE.synapses + 1},
        {'values': np.nextafter(ONE.values, 1.0)},
    ):  # fmt: skip
        other = replace(ONE, **changes)
        assert not ONE.same_as(other)
        assert ONE.checksum() != other.checksum()
    everything = every(NEURONS.prior_weights, PRIOR)
    assert np.array_equal(NEURONS.synapses(everything).dense(), NEURONS.prior_weights)
