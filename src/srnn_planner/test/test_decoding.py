# SPDX-License-Identifier: Apache-2.0
"""Decoding against the formula of the paper, neuron by neuron."""

import numpy as np
import pytest

from srnn_planner.core.decoding import decode, spike_activity, window
from srnn_planner.core.encoding import NO_SPIKE
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.state_neurons import StateNeurons

TAU, STEPS, SIGMA = 10, 30, 3.0


@pytest.fixture
def spikes(rng):
    return rng.random((4, STEPS, 225)) < 0.01


def test_filtering_sums_equals_filtering_every_train(spikes):
    positions = StateNeurons(NetworkParameters()).positions
    history = np.full((4, 225), NO_SPIKE)
    activity = spike_activity(spikes, history, positions, TAU)
    paths, valid = decode(activity, window(STEPS, TAU, SIGMA))
    lag = np.arange(STEPS)[:, None] - np.arange(STEPS)[None, :]
    filtered = np.einsum('tu,suk->stk', np.exp(-0.5 * (lag / SIGMA) ** 2), spikes)
    expected = filtered @ positions / filtered.sum(axis=2, keepdims=True)
    assert valid.all()
    assert paths == pytest.approx(expected)


def test_decoded_states_lie_within_the_grid(spikes):
    positions = StateNeurons(NetworkParameters()).positions
    activity = spike_activity(spikes, np.full((4, 225), NO_SPIKE), positions, TAU)
    paths, _ = decode(activity, window(STEPS, TAU, SIGMA))
    assert np.abs(paths).max() <= 1.0


def test_silent_sample_is_not_valid():
    positions = StateNeurons(NetworkParameters()).positions
    silent = np.zeros((2, STEPS, 225), dtype=bool)
    silent[1, ::5, 7] = True
    activity = spike_activity(silent, np.full((2, 225), NO_SPIKE), positions, TAU)
    _, valid = decode(activity, window(STEPS, TAU, SIGMA))
    assert valid.tolist() == [False, True]


def test_history_pulls_the_first_states_to_where_it_spiked():
    positions = StateNeurons(NetworkParameters()).positions
    history = np.full((1, 225), NO_SPIKE)
    history[0, 40] = -1
    trains = np.zeros((1, STEPS, 225), dtype=bool)
    trains[0, 10::3, 200] = True
    activity = spike_activity(trains, history, positions, TAU)
    paths, _ = decode(activity, window(STEPS, TAU, SIGMA))
    assert paths[0, 0] == pytest.approx(positions[40], abs=0.02)
    assert paths[0, -1] == pytest.approx(positions[200], abs=1e-6)
