# SPDX-License-Identifier: Apache-2.0
"""What sampling cannot do without: its random words, and the weights of whoever spikes.

No sampler of this kind is faster than a loop that draws as many random words, and adds and
takes away the same weights in the same order, and does nothing else.
"""

from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.random_words import STEP, word
from srnn_planner.core.sampler import Sampler
from srnn_planner.core.sampling import SampleInput, sample_spikes
from srnn_planner.core.sampling_kernel import LANES
from srnn_planner.core.synapse_spans import SynapseSpans


@dataclass(frozen=True, eq=False)
class Work:
    """What sampling one segment takes.

    Attributes:
        spikes: number of spikes.
        words: random words drawn.
        rows: (n,) neurons whose weights are added to all potentials, or taken away, in order.

    """

    spikes: int
    words: int
    rows: NDArray[np.int64]


def work(network: NetworkParameters, given: SampleInput, sampler: Sampler) -> Work:
    """Return what the compiled sampler does for spikes like those of the reference."""
    law, tau = sampler.law, network.tau
    samples, steps, neurons = given.uniforms.shape
    spikes = sample_spikes(network, given)
    last = given.history.astype(np.int64)
    context_last = np.full(given.context_uniforms[:, 0].shape, -tau - 1)
    rows, words = [np.nonzero(t0 := (last >= -tau))[1]], samples
    active = t0
    for t in range(steps):
        potential = t - last <= tau
        rows += [np.nonzero(potential != active)[1]] if t else []
        active = potential
        heard = (t - context_last <= tau).astype(np.float64)
        u = given.bias + potential @ given.weights.astype(float) + heard @ given.context.weights
        likely = (u > law.seldom) & ~(potential & law.absolute)
        padded = np.pad(likely, ((0, 0), (0, -neurons % LANES))).reshape(samples, -1, LANES)
        # Half of those that may spike fall away with each word, and who is left draws one.
        words += law.halvings * int(padded.any(axis=2).sum())
        words += round(likely.sum() * 0.5**law.halvings)
        # One word decides half of all context neurons, the next half of those left.
        words += samples * round(1 + np.log2(given.context_uniforms.shape[2]))
        last[spikes[:, t]] = t
        context_last[given.context_uniforms[:, t] < given.context.spike_probability[t]] = t
    words += round(2.0 * law.rare * samples * steps * neurons)
    return Work(int(spikes.sum()), words, np.concatenate(rows))


@numba.njit(cache=True)
def draw(count):
    """Draw random words, and return what they add up to."""
    state, total = np.uint64(1), np.uint64(0)
    for _ in range(count):
        total += word(state)
        state += STEP
    return total


def add(synapses: SynapseSpans, rows: NDArray[np.int64]) -> None:
    """Add the weights of neurons to potentials."""
    neurons = len(synapses.first) - 1
    _add(synapses.first, synapses.start, synapses.values, rows, neurons)


@numba.njit(cache=True)
def _add(first, start, values, rows, neurons):
    u = np.zeros(neurons + values.shape[1] + LANES, dtype=np.int32)
    for k in rows:
        for n in range(first[k], first[k + 1]):
            low, span = np.uint64(start[n]), values[n]
            for i in range(np.uint64(len(span))):
                u[low + np.uint64(i)] += span[np.uint64(i)]
    return u
