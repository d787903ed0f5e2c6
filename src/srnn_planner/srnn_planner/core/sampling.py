# SPDX-License-Identifier: Apache-2.0
"""Sampling movements by running the network: the plain NumPy reference.

`sampler` does the same fast, with other random numbers: its spikes have the same
distribution.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.context import ContextPopulation
from srnn_planner.core.decoding import spike_activity
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses


@dataclass(frozen=True, eq=False)
class SampleInput:
    """Everything that determines a set of samples.

    Attributes:
        weights: (K, K) recurrent weights w[pre, post].
        context: the active context population of N neurons over T steps.
        bias: (K,) input of context neurons that spike all the time.
        history: (S, K) step of each neuron's last spike before 0, see `draw_history`.
        uniforms: (S, T, K) numbers from [0, 1) that decide the spikes.
        context_uniforms: (S, T, N) the same for the context neurons.

    """

    weights: NDArray[np.float32]
    context: ContextPopulation
    bias: NDArray[np.float64]
    history: NDArray[np.int32]
    uniforms: NDArray[np.float32]
    context_uniforms: NDArray[np.float32]


def sample_spikes(network: NetworkParameters, given: SampleInput) -> NDArray[np.bool_]:
    """Run the network S times for T steps and return its spikes (S, T, K).

    In each step the membrane potential u = w^T v~ + theta^T y~ (eq. 1) gives the
    spike probability rho = min(p_max, exp(beta u - c)), which the refractory state
    then silences (absolute) or scales by (t - t_spike) / tau (linear).
    """
    tau = network.tau
    samples, steps, neurons = given.uniforms.shape
    last = given.history.copy()
    context_last = np.full(given.context_uniforms[:, 0].shape, -tau - 1)
    weights = given.weights.astype(np.float64)
    spikes = np.zeros((samples, steps, neurons), dtype=bool)
    for t in range(steps):
        potential = (t - last <= tau).astype(np.float64)
        context_potential = (t - context_last <= tau).astype(np.float64)
        u = given.bias + potential @ weights + context_potential @ given.context.weights
        spikes[:, t] = given.uniforms[:, t] < activation(network, u, t - last)
        last[spikes[:, t]] = t
        fired = given.context_uniforms[:, t] < given.context.spike_probability[t]
        context_last[fired] = t
    return spikes


def activation(
    network: NetworkParameters, u: NDArray[np.float64], since: NDArray[np.integer]
) -> NDArray[np.float64]:
    """Return the spike probability rho for membrane potential u.

    Args:
        network: slope beta, threshold c, limit p_max, tau and form of refractoriness.
        u: membrane potentials, any shape.
        since: steps since the neuron's last spike, same shape.

    """
    exponent = np.minimum(network.slope * u - network.threshold, 0.0)
    rho = np.minimum(network.spike_probability_max, np.exp(exponent))
    recovering = since <= network.tau
    if network.refractory == 'absolute':
        return np.asarray(np.where(recovering, 0.0, rho))
    return np.asarray(np.where(recovering, rho * since / network.tau, rho))


class PlainSampler:
    """What `sampler.Sampler` is, without anything compiled."""

    def __init__(
        self,
        neurons: StateNeurons,
        bias: NDArray[np.float64],
        context_max: float,
    ) -> None:
        """See `Sampler`."""
        self._network, self._positions = neurons.parameters, neurons.positions
        self._bias = bias
        self._weights: NDArray[np.float32]

    def use_weights(self, synapses: Synapses) -> None:
        """See `Sampler`."""
        self._weights = synapses.dense()

    def sample(
        self,
        context: ContextPopulation,
        history: NDArray[np.int32],
        seeds: NDArray[np.uint64],
    ) -> tuple[NDArray[np.uint16], NDArray[np.float64]]:
        """See `Sampler`; random numbers are other ones."""
        rng = np.random.default_rng(seeds)
        size = (len(history), len(context.spike_probability))
        given = SampleInput(
            self._weights, context, self._bias, history,
            rng.random((*size, self._network.neurons), dtype=np.float32),
            rng.random((*size, len(context.weights)), dtype=np.float32),
        )  # fmt: skip
        spikes = sample_spikes(self._network, given)
        activity = spike_activity(spikes, history, self._positions, self._network.tau)
        return spikes.sum(axis=0, dtype=np.uint16), activity
