# SPDX-License-Identifier: Apache-2.0
"""What sampling cannot do without: its random words, and the memory it has to go through.

No sampler of this kind is faster than loops that draw as many random words, add and take away
the same weights in the same order, look at every potential once a step, and decide nothing.
"""

from dataclasses import dataclass

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.intrinsics import above
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
        words: random words drawn.
        rows: (n,) neurons whose weights are added to all potentials, or taken away, in order.
        steps: how often all potentials are looked at.

    """

    words: int
    rows: NDArray[np.int64]
    steps: int


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
        # Half of those that may spike fall away with each word, and who is left draws one.
        words += law.halvings * samples * -(-neurons // LANES)
        words += round(likely.sum() * 0.5**law.halvings)
        # One word decides half of all context neurons, the next half of those left.
        words += samples * round(1 + np.log2(given.context_uniforms.shape[2]))
        last[spikes[:, t]] = t
        context_last[given.context_uniforms[:, t] < given.context.spike_probability[t]] = t
    words += round(2.0 * law.rare * samples * steps * neurons)
    return Work(words, np.concatenate(rows), samples * steps)


@numba.njit(cache=True)
def draw(count):
    """Draw random words, and return what they add up to."""
    state, total = np.uint64(1), np.uint64(0)
    for _ in range(count):
        total += word(state)
        state += STEP
    return total


def go_through(synapses: SynapseSpans, work: Work) -> None:
    """Add the weights of all rows to potentials, and look at these as often as is needed."""
    neurons = len(synapses.pattern)
    _go_through(synapses, work.rows, work.steps, neurons)


@numba.njit(cache=True)
def _go_through(synapses, rows, steps, neurons):
    blocks = (neurons + LANES - 1) // LANES
    u = np.zeros(blocks * LANES + synapses.values.shape[1], dtype=np.int32)
    seen, row = np.uint64(0), 0
    for step in range(steps):
        while row < len(rows) * (step + 1) // steps:
            k = rows[row]
            row += 1
            pattern = synapses.pattern[k]
            for n in range(synapses.first[pattern], synapses.first[pattern + 1]):
                low, span = np.uint64(k + synapses.start[n]), synapses.values[n]
                for i in range(np.uint64(len(span))):
                    u[low + np.uint64(i)] += span[np.uint64(i)]
        for block in range(blocks):
            seen |= above(u, block * LANES, np.int32(0))
    return seen
