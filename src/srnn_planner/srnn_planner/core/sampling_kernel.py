# SPDX-License-Identifier: Apache-2.0
"""The compiled sampler: same spikes as `sampling.sample_spikes`, in a few milliseconds.

Membrane potentials are kept up to date by the few neurons whose postsynaptic
potential begins or ends in a step. Only neurons whose uniform number lies below the
limit of the spike probability are looked at, and most of these are ruled out before
an exponential is taken.
"""

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.sampling import SampleInput


def sample_activity(
    network: NetworkParameters, positions: NDArray[np.float64], given: SampleInput
) -> tuple[NDArray[np.uint8], NDArray[np.float64]]:
    """Run the network S times for T steps.

    Args:
        network: the network's parameters.
        positions: (K, d) preferred positions of the state neurons.
        given: weights, context, history and random numbers.

    Returns:
        spikes: (S, T, K) zeros and ones.
        activity: (S, tau + T, d + 1) for each step, history included, the sum of the
            positions of the neurons that spiked and, last, their number.

    """
    return _sample(
        given.weights,
        given.context.weights,
        given.context.spike_probability,
        given.bias,
        given.history,
        given.draws.neurons,
        given.draws.values,
        given.draws.offsets,
        given.context_uniforms,
        positions,
        network.tau,
        network.slope,
        network.threshold,
        network.spike_probability_max,
        network.refractory == 'absolute',
    )


@numba.njit(cache=True)
def _sample(
    weights, theta, context_probability, bias, history, drawn, draws, offsets, context_uniforms,
    positions, tau, slope, threshold, limit, absolute,
):
    samples, steps, context_neurons = context_uniforms.shape
    neurons, dimensions = positions.shape
    spikes = np.zeros((samples, steps, neurons), dtype=np.uint8)
    activity = np.zeros((samples, tau + steps, dimensions + 1))
    u = np.empty(neurons)
    last = np.empty(neurons, dtype=np.int32)
    begun = np.empty(neurons, dtype=np.int64)
    # Neurons by the step of their spike, modulo tau + 1: those whose potential ends next.
    ring = np.empty((tau + 1, neurons), dtype=np.int32)
    ring_count = np.empty(tau + 1, dtype=np.int64)
    context_last = np.empty(context_neurons, dtype=np.int64)
    for s in range(samples):
        _begin(s, history, weights, bias, positions, tau, u, last, activity, ring, ring_count)
        context_last[:] = -tau - 1
        begun_count = 0
        for t in range(steps):
            slot = t % (tau + 1)
            _advance_potentials(
                t, tau, weights, u, last, begun, begun_count, ring[slot], ring_count[slot]
            )
            ring_count[slot] = 0
            _advance_context(
                t, tau, s, theta, context_probability, context_uniforms, u, context_last
            )
            begun_count = 0
            step = s * steps + t
            for n in range(offsets[step], offsets[step + 1]):
                k = drawn[n]
                since = t - last[k]
                if absolute and since <= tau:
                    continue
                x = min(slope * u[k] - threshold, 0.0)
                # exp(x) < 1 / (1 - x + x^2/2 - x^3/6) for x < 0 rules most spikes out.
                if draws[n] * (1.0 - x * (1.0 - x * (0.5 - x * 0.16666))) > 1.0:
                    continue
                rho = min(limit, np.exp(x))
                if since <= tau:
                    rho = rho * since / tau
                if draws[n] < rho:
                    spikes[s, t, k] = 1
                    if since > tau:
                        begun[begun_count] = k
                        begun_count += 1
                    last[k] = t
                    ring[slot, ring_count[slot]] = k
                    ring_count[slot] += 1
                    _count(activity, s, tau + t, positions, k)
    return spikes, activity


@numba.njit(cache=True, inline='always')
def _count(activity, s, step, positions, k):
    dimensions = positions.shape[1]
    for j in range(dimensions):
        activity[s, step, j] += positions[k, j]
    activity[s, step, dimensions] += 1.0


@numba.njit(cache=True)
def _begin(s, history, weights, bias, positions, tau, u, last, activity, ring, ring_count):
    neurons = len(u)
    u[:] = bias
    ring_count[:] = 0
    for k in range(neurons):
        last[k] = history[s, k]
        if last[k] >= -tau:
            slot = last[k] % (tau + 1)
            ring[slot, ring_count[slot]] = k
            ring_count[slot] += 1
            _count(activity, s, tau + last[k], positions, k)
            for i in range(neurons):
                u[i] += weights[k, i]


@numba.njit(cache=True)
def _advance_potentials(t, tau, weights, u, last, begun, begun_count, ending, ending_count):
    neurons = len(u)
    for n in range(begun_count):
        k = begun[n]
        for i in range(neurons):
            u[i] += weights[k, i]
    for n in range(ending_count):
        k = ending[n]
        if t - last[k] == tau + 1:
            for i in range(neurons):
                u[i] -= weights[k, i]


@numba.njit(cache=True)
def _advance_context(
    t, tau, s, theta, probability, uniforms, u, context_last
):
    """Change of y~ from t - 1 to t: spikes of t - 1 begin, those of t - tau - 1 end."""
    neurons = len(u)
    for j in range(len(context_last)):
        active = t - 1 - context_last[j] <= tau and t > 0
        if t > 0 and uniforms[s, t - 1, j] < probability[t - 1]:
            context_last[j] = t - 1
            if not active:
                for i in range(neurons):
                    u[i] += theta[j, i]
        elif active and t - context_last[j] == tau + 1:
            for i in range(neurons):
                u[i] -= theta[j, i]
