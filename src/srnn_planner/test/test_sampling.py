# SPDX-License-Identifier: Apache-2.0
"""The sampler: kernel against reference, statistics against stated probabilities."""

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest
import sampling_oracle
from statistical_bounds import binomial_bound

from srnn_planner.core.context import ContextPopulation, draw_centres, way_point_population
from srnn_planner.core.encoding import NO_SPIKE, draw_history, spike_probability
from srnn_planner.core.parameters import (
    ContextParameters,
    LearningParameters,
    NetworkParameters,
)
from srnn_planner.core.random_words import seeds
from srnn_planner.core.sampler import Sampler
from srnn_planner.core.sampling import SampleInput, activation, sample_spikes
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses

CONTEXT = ContextParameters(spike_probability_start=0.05, spike_probability_end=0.4)


def sample_case(network, rng, samples=6, steps=30, context_neurons=10):
    """Return neurons, weights, context, bias and history of a network at random."""
    neurons = StateNeurons(network)
    parameters = replace(CONTEXT, neurons=context_neurons)
    target = rng.uniform(-0.8, 0.8, network.dimensions)
    centres = draw_centres(target, parameters, rng)
    context = way_point_population(centres, neurons.positions, steps, parameters)
    start = neurons.responsibilities(rng.uniform(-0.8, 0.8, (1, network.dimensions)))[0]
    probability = spike_probability(start, LearningParameters())
    # Some synapses have learned, as many as there are neurons.
    weights = neurons.prior_weights.copy()
    changed = rng.integers(0, network.neurons, (2, network.neurons))
    weights[tuple(changed)] += rng.normal(0.0, 0.3, network.neurons).astype(np.float32)
    history = draw_history(probability, samples, network.tau, rng)
    return neurons, np.clip(weights, -1, 1), context, -rng.random(network.neurons), history


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    refractory=st.sampled_from(['absolute', 'linear']),
    tau=st.integers(1, 12),
    shape=st.sampled_from([(1, 25), (2, 9), (2, 15), (3, 5), (1, 101), (2, 25)]),
    limit=st.sampled_from([0.05, 0.2, 0.5, 0.9, 1.0]),
    threshold=st.sampled_from([3.644, 1.0, 6.0]),
    context_neurons=st.sampled_from([1, 10, 70]),
)
def test_kernel_gives_the_spikes_of_plain_python(
    seed, refractory, tau, shape, limit, threshold, context_neurons
):
    network = NetworkParameters(
        refractory=refractory, tau=tau, dimensions=shape[0], neurons_per_dimension=shape[1],
        spike_probability_max=limit, threshold=threshold,
    )  # fmt: skip
    rng = np.random.default_rng(seed)
    neurons, weights, context, bias, history = sample_case(
        network, rng, samples=2, context_neurons=context_neurons
    )
    sampler = Sampler(neurons, bias, CONTEXT.amplitude)
    sampler.use_weights(Synapses.of(neurons.prior, weights))
    states = seeds(rng, 2)
    spikes, activity = sampler.sample(context, history, states)
    expected = sampling_oracle.sample(
        sampler, context, history, states, neurons.positions, bias
    )
    assert np.array_equal(spikes, expected[0])
    assert activity == pytest.approx(expected[1], abs=1e-12)


@pytest.mark.parametrize(
    'network',
    [
        NetworkParameters(),
        NetworkParameters(refractory='linear', threshold=5.0),
        NetworkParameters(spike_probability_max=0.9, neurons_per_dimension=9, sigma=0.2),
        NetworkParameters(dimensions=1, neurons_per_dimension=40, threshold=3.0, sigma=0.05),
    ],
)
def test_kernel_has_the_distribution_of_the_reference(network, rng):
    """Spikes of each step and of each neuron, from as many runs of both, with other numbers.

    Sums over a sample are independent between samples and near normal: the difference of two
    means of 600 samples lies beyond 6 standard errors with a probability below 1e-8 each; at
    most 300 are compared.
    """
    samples, steps = 600, 40
    neurons, weights, context, bias, history = sample_case(network, rng, samples, steps)
    bias *= 0.2
    size = (samples, steps)
    reference = sample_spikes(network, SampleInput(
        weights, context, bias, history,
        rng.random((*size, network.neurons), dtype=np.float32),
        rng.random((*size, len(context.weights)), dtype=np.float32),
    ))  # fmt: skip
    sampler = Sampler(neurons, bias, CONTEXT.amplitude)
    sampler.use_weights(Synapses.of(neurons.prior, weights))
    states = seeds(rng, samples)
    runs = [
        sampler.sample(context, history[n : n + 1], states[n : n + 1])[0] for n in range(samples)
    ]
    ours, theirs = np.array(runs, dtype=float), reference.astype(float)
    assert theirs.sum() > 20 * samples
    for axis in (1, 2):
        one, other = ours.sum(axis=axis), theirs.sum(axis=axis)
        error = np.sqrt((one.var(axis=0) + other.var(axis=0) + 0.01) / samples)
        assert (np.abs(one.mean(axis=0) - other.mean(axis=0)) <= 6.0 * error).all()


def test_the_same_words_give_the_same_spikes_whoever_else_is_sampled(rng):
    network = NetworkParameters()
    neurons, weights, context, bias, history = sample_case(network, rng)
    sampler = Sampler(neurons, bias, CONTEXT.amplitude)
    sampler.use_weights(Synapses.of(neurons.prior, weights))
    states = seeds(rng, len(history))
    _, together = sampler.sample(context, history, states)
    _, alone = sampler.sample(context, history[3:4], states[3:4])
    assert np.array_equal(together[3], alone[0])


@pytest.mark.parametrize('huge', [-1000.0, 0.0])
def test_no_weights_and_no_input_make_sums_overflow(huge, rng):
    """Weights of +1 everywhere excite without end; whole numbers have to hold it."""
    network = NetworkParameters(spike_probability_max=1.0, tau=30)
    neurons, _, context, _, history = sample_case(network, rng, samples=1)
    bias = np.full(network.neurons, huge)
    for weight in (1.0, -1.0):
        sampler = Sampler(neurons, bias, CONTEXT.amplitude)
        everywhere = np.full((network.neurons,) * 2, weight, dtype=np.float32)
        sampler.use_weights(Synapses.of(neurons.prior, everywhere))
        states = seeds(rng, 1)
        spikes, _ = sampler.sample(context, history, states)
        expected = sampling_oracle.sample(
            sampler, context, history, states, neurons.positions, bias
        )
        assert np.array_equal(spikes, expected[0])
        assert bool(spikes.sum() > 100) == (weight > 0.0 and huge == 0.0)


def isolated(network, samples, steps, rng):
    """Return an input without recurrent or context input, so that u = 0 throughout."""
    count = network.neurons
    return SampleInput(
        weights=np.zeros((count, count), dtype=np.float32),
        context=ContextPopulation(np.zeros((1, count)), np.zeros(steps)),
        bias=np.zeros(count),
        history=np.full((samples, count), NO_SPIKE, dtype=np.int32),
        uniforms=rng.random((samples, steps, count), dtype=np.float32),
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
