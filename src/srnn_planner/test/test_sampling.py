# SPDX-License-Identifier: Apache-2.0
"""The sampler: kernel against reference, statistics against stated probabilities."""

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest
from statistical_bounds import binomial_bound

from srnn_planner.core.context import ContextPopulation, draw_centres, way_point_population
from srnn_planner.core.decoding import spike_activity
from srnn_planner.core.encoding import NO_SPIKE, draw_history, spike_probability
from srnn_planner.core.parameters import (
    ContextParameters,
    LearningParameters,
    NetworkParameters,
)
from srnn_planner.core.sampling import SampleInput, activation, sample_spikes, thin
from srnn_planner.core.sampling_kernel import sample_activity
from srnn_planner.core.state_neurons import StateNeurons

CONTEXT = ContextParameters(spike_probability_start=0.05, spike_probability_end=0.4)


def sample_input(network, rng, samples=6, steps=30):
    neurons = StateNeurons(network)
    target = rng.uniform(-0.8, 0.8, network.dimensions)
    centres = draw_centres(target, CONTEXT, rng)
    context = way_point_population(centres, neurons.positions, steps, CONTEXT)
    start = neurons.responsibilities(rng.uniform(-0.8, 0.8, (1, network.dimensions)))[0]
    probability = spike_probability(start, LearningParameters())
    return neurons, SampleInput(
        weights=np.clip(
            neurons.prior_weights + rng.normal(0, 0.1, neurons.prior_weights.shape), -1, 1
        ).astype(np.float32),
        context=context,
        bias=-rng.random(network.neurons),
        history=draw_history(probability, samples, network.tau, rng),
        draws=thin(
            rng.random((samples, steps, network.neurons), dtype=np.float32),
            network.spike_probability_max,
        ),
        context_uniforms=rng.random((samples, steps, len(context.weights)), dtype=np.float32),
    )


@settings(max_examples=15, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    refractory=st.sampled_from(['absolute', 'linear']),
    tau=st.integers(1, 12),
    shape=st.sampled_from([(1, 25), (2, 9), (2, 15), (3, 5)]),
)
def test_kernel_gives_the_spikes_of_the_reference(seed, refractory, tau, shape):
    network = NetworkParameters(
        refractory=refractory, tau=tau, dimensions=shape[0], neurons_per_dimension=shape[1]
    )
    neurons, given_ = sample_input(network, np.random.default_rng(seed))
    expected = sample_spikes(network, given_)
    spikes, activity = sample_activity(network, neurons.positions, given_)
    assert np.array_equal(spikes.astype(bool), expected)
    reference = spike_activity(expected, given_.history, neurons.positions, tau)
    assert activity == pytest.approx(reference, abs=1e-12)


def isolated(network, samples, steps, rng):
    """Return an input without recurrent or context input, so that u = 0 throughout."""
    count = network.neurons
    return SampleInput(
        weights=np.zeros((count, count), dtype=np.float32),
        context=ContextPopulation(np.zeros((1, count)), np.zeros(steps)),
        bias=np.zeros(count),
        history=np.full((samples, count), NO_SPIKE),
        draws=thin(
            rng.random((samples, steps, count), dtype=np.float32), network.spike_probability_max
        ),
        context_uniforms=rng.random((samples, steps, 1), dtype=np.float32),
    )


def test_spike_frequency_is_rho_within_a_binomial_bound(rng):
    """One step, u = 0: rho = exp(-c); two-sided bound of false-alarm rate 1e-6."""
    network = NetworkParameters(threshold=2.5, spike_probability_max=0.5)
    spikes = sample_spikes(network, isolated(network, 400, 1, rng))
    rho = np.exp(-2.5)
    assert abs(spikes.sum() - rho * spikes.size) <= binomial_bound(spikes.size, rho)


def test_spike_frequency_never_exceeds_its_limit(rng):
    network = NetworkParameters(threshold=-5.0, spike_probability_max=0.15)
    spikes = sample_spikes(network, isolated(network, 400, 1, rng))
    assert abs(spikes.sum() - 0.15 * spikes.size) <= binomial_bound(spikes.size, 0.15)


def test_absolute_refractoriness_silences_for_tau_steps(rng):
    network = NetworkParameters(threshold=-5.0, spike_probability_max=1.0, tau=7)
    spikes = sample_spikes(network, isolated(network, 3, 40, rng))
    for train in spikes.transpose(0, 2, 1).reshape(-1, 40):
        assert (np.diff(np.flatnonzero(train)) == 8).all()


def test_linear_refractoriness_recovers_in_proportion_to_time():
    network = NetworkParameters(refractory='linear', tau=10, threshold=1.0)
    since = np.arange(1, 15)
    rho = activation(network, np.zeros(14), since)
    free = min(network.spike_probability_max, np.exp(-1.0))
    assert rho == pytest.approx(np.minimum(since / 10, 1.0) * free)


def test_activation_is_exponential_below_its_limit():
    network = replace(NetworkParameters(), slope=2.0, threshold=5.0)
    u = np.linspace(-3.0, 1.5, 20)
    rho = activation(network, u, np.full(20, 99))
    assert rho == pytest.approx(np.exp(2.0 * u - 5.0))


def test_context_weights_fall_with_the_distance_to_the_way_point(rng):
    neurons = StateNeurons(NetworkParameters())
    target = np.array([0.4, 0.1])
    still = replace(ContextParameters(), spread=0.0)
    centres = draw_centres(target, still, rng)
    weights = way_point_population(centres, neurons.positions, 30, still).weights.sum(axis=0)
    distance = np.linalg.norm(neurons.positions - target, axis=1)
    assert (np.diff(weights[np.argsort(distance)]) <= 1e-12).all()
    closed = still.amplitude * np.exp(-((distance / still.scale) ** still.exponent))
    assert weights == pytest.approx(closed)
    detour = rng.uniform(0.0, 1.0, len(distance))
    longer = way_point_population(centres, neurons.positions, 30, still, detour)
    closed = still.amplitude * np.exp(-(((distance + detour) / still.scale) ** still.exponent))
    assert longer.weights.sum(axis=0) == pytest.approx(closed)


def test_context_fires_with_its_time_dependent_probability():
    population = way_point_population(
        np.zeros((10, 2)), StateNeurons(NetworkParameters()).positions, 30, CONTEXT
    )
    assert population.spike_probability == pytest.approx(np.linspace(0.05, 0.4, 30))


@given(seed=st.integers(0, 2**32 - 1), limit=st.sampled_from([0.001, 0.2, 1.0]))
def test_thinning_leaves_out_only_what_cannot_spike(seed, limit):
    uniforms = np.random.default_rng(seed).random((3, 4, 30), dtype=np.float32)
    draws = thin(uniforms, limit)
    below = uniforms < np.float32(limit)
    assert np.array_equal(draws.dense(), np.where(below, uniforms, np.float32(1.0)))
    assert draws.offsets[-1] == below.sum()
