# SPDX-License-Identifier: Apache-2.0
"""Spike encoding against its closed form and its stated statistics."""

import math

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest
from statistical_bounds import binomial_bound

from srnn_planner.core.encoding import (
    NO_SPIKE,
    draw_history,
    encode,
    postsynaptic_potential,
    spike_probability,
)
from srnn_planner.core.parameters import LearningParameters, NetworkParameters
from srnn_planner.core.state_neurons import StateNeurons

LEARNING = LearningParameters()


def test_spike_probability_is_the_poisson_tail():
    omega = np.linspace(0.0, 0.3, 200)
    rate = np.clip(LEARNING.rate_scale * omega, 0.0, LEARNING.rate_limit)
    counts = range(LEARNING.spike_count, 80)
    expected = sum(np.exp(-rate) * rate**n / float(math.factorial(n)) for n in counts)
    assert spike_probability(omega, LEARNING) == pytest.approx(expected, abs=1e-12)


def test_spike_frequency_lies_in_its_binomial_bounds(rng):
    """Two-sided bound of false-alarm rate 1e-6 for each of 40 neurons."""
    probability = np.linspace(0.02, 0.9, 40)
    draws = 20_000
    spikes = rng.random((draws, 40)) < probability
    first = np.array([encode(probability[None], u[None], 10)[0] for u in rng.random((500, 40))])
    for count, number in ((spikes.sum(axis=0), draws), (first.sum(axis=0), 500)):
        bound = binomial_bound(number, probability)
        assert (np.abs(count - number * probability) <= bound).all()


@given(seed=st.integers(0, 2**32 - 1), tau=st.integers(1, 15))
def test_no_neuron_spikes_twice_within_its_refractory_period(seed, tau):
    rng = np.random.default_rng(seed)
    spikes = encode(rng.random((40, 20)), rng.random((40, 20)), tau)
    for train in spikes.T:
        assert (np.diff(np.flatnonzero(train)) > tau).all()


@given(seed=st.integers(0, 2**32 - 1), tau=st.integers(1, 12))
def test_potential_is_one_if_there_was_a_spike_in_the_last_tau_steps(seed, tau):
    spikes = np.random.default_rng(seed).random((25, 6)) < 0.1
    potential = postsynaptic_potential(spikes, tau)
    for t in range(25):
        assert np.array_equal(potential[t], spikes[max(0, t - tau) : t].any(axis=0))


def test_history_lies_within_tau_steps_and_near_the_position(rng):
    neurons = StateNeurons(NetworkParameters())
    omega = neurons.responsibilities(np.array([[0.3, -0.2]]))[0]
    history = draw_history(spike_probability(omega, LEARNING), 400, 10, rng)
    spiked = history != NO_SPIKE
    assert set(np.unique(history[spiked])) == set(range(-10, 0))
    centre = neurons.positions[np.nonzero(spiked)[1]].mean(axis=0)
    assert centre == pytest.approx([0.3, -0.2], abs=0.02)


def test_encoded_position_decodes_to_itself():
    """decode(encode(x)) is x within a fifth of the grid spacing; the clipped rates bias it."""
    neurons = StateNeurons(NetworkParameters())
    rng = np.random.default_rng(5)
    for point in rng.uniform(-0.9, 0.9, (20, 2)):
        p = spike_probability(neurons.responsibilities(point[None])[0], LEARNING)
        spikes = rng.random((200, len(p))) < p
        mean = (spikes @ neurons.positions).sum(axis=0) / spikes.sum()
        assert np.linalg.norm(mean - point) < 0.2 / 7
