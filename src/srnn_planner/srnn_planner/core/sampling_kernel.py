# SPDX-License-Identifier: Apache-2.0
"""The compiled sampler: spikes with the probabilities of `sampling.sample_spikes`.

Time goes with spikes, not with neurons. Membrane potentials are kept up to date by the few
neurons whose postsynaptic potential begins or ends in a step. Spikes are drawn by thinning
(Lewis and Shedler 1979), which is exact: neurons that may well spike lie within the reach of
those that have, and are found by their potential, 64 at a time, half of them being ruled out
by each random bit that the limit of the spike probability allows. All others spike with at
most a tiny probability; how many of them are passed over at a time is drawn at once, and who
is met spikes with its share of that bound.
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.elementary import LOWEST, exp
from srnn_planner.core.intrinsics import above, lowest_bit
from srnn_planner.core.random_words import STEP, bernoulli_word, gap, uniform, word
from srnn_planner.core.synapse_spans import ROOM

SILENT = 2**30
"""Taken from the potential of a neuron that cannot spike: more than all others can give."""

LANES = 64
"""Neurons looked at together."""

_ZERO, _ONE = np.uint64(0), np.uint64(1)


class Law(NamedTuple):
    """When a neuron spikes, for the compiled sampler."""

    tau: int
    slope: float
    threshold: float
    absolute: bool
    halvings: int
    """The limit is at most 2 to the minus this."""
    saturated: float
    """Logarithm of the limit."""
    rare: float
    """Neurons whose potential is below `seldom` spike with at most this probability."""
    seldom: float


class _Cells(NamedTuple):
    """What changes of the state neurons from step to step."""

    u: NDArray[np.int32]
    """Membrane potentials without what all of them have in common."""
    last: NDArray[np.int32]
    """(K,) step of the last spike."""
    ring: NDArray[np.int32]
    """(tau + 1, K) who spiked, by step modulo tau + 1: whose potentials end next."""
    spiked: NDArray[np.int64]
    """(tau + 1,) how many."""


class _ContextCells(NamedTuple):
    """Context neurons, 64 to a word."""

    theta: NDArray[np.int32]
    high: NDArray[np.int64]
    """(N,) largest weight of each."""
    wanted: NDArray[np.uint64]
    fired: NDArray[np.uint64]
    """(groups, tau + 1) who spiked, by step modulo tau + 1."""
    active: NDArray[np.uint64]


@numba.njit(cache=True, error_model='numpy')
def sample(synapses, bias, theta, probability, history, seeds, positions, law):
    """Run the network: see `sampler.Sampler.sample`.

    Takes `SynapseSpans`, bias (K,) and context weights theta (N, K) as whole numbers, the
    probability (T,) that a context neuron spikes, history (S, K), seeds (S,), positions (K, d).
    """
    samples, neurons = history.shape
    steps, tau, dimensions = len(probability), law.tau, positions.shape[1]
    spikes = np.zeros((steps, neurons), dtype=np.uint16)
    activity = np.zeros((samples, tau + steps, dimensions + 1))
    blocks = (neurons + LANES - 1) // LANES
    cells = _Cells(
        # Spans may end beyond the last neuron.
        np.full(blocks * LANES + synapses.values.shape[1], -SILENT, dtype=np.int32),
        np.empty(neurons, dtype=np.int32),
        np.empty((tau + 1, neurons), dtype=np.int32),
        np.empty(tau + 1, dtype=np.int64),
    )
    context = _context_cells(theta, tau)
    bias_high = np.int64(bias.max())
    seldom = np.int64(np.ceil(law.seldom * synapses.scale))
    slope = law.slope / synapses.scale
    share, passing = 0.5**law.halvings, 1.0 / np.log1p(-law.rare)
    for s in range(samples):
        state = seeds[s]
        cells.u[:neurons] = bias
        context.active[:] = context.fired[:] = _ZERO
        active, earlier = _begin(synapses, cells, history[s], positions, activity[s], law)
        # Who was active in the last tau + 1 steps spiked in the last two stretches of as many.
        reach, high = (neurons, 0), bias_high
        to_pass = gap(state, passing)
        state += STEP
        slot = -1
        for t in range(steps + 1):
            if t > 0:
                active, reach = _take_in(synapses, cells, law, t - 1, slot, active, reach)
                # Unsigned, or numba makes room for indices that count from the end.
                for n in range(np.uint64(cells.spiked[slot])):
                    k = np.uint64(cells.ring[slot, n])
                    spikes[t - 1, k] += 1
                    for j in range(np.uint64(dimensions)):
                        activity[s, tau + t - 1, j] += positions[k, j]
                activity[s, tau + t - 1, dimensions] = cells.spiked[slot]
            if t == steps:
                break
            slot += 1
            if slot > tau:
                slot, earlier, reach = 0, reach, (neurons, 0)
            active = _end(synapses, cells, law, t, slot, active)
            high, state = _advance_context(context, cells.u, slot, high, probability[t], state)
            common = active * synapses.rest
            likely = min(seldom - common, np.int64(ROOM))
            first_block, last_block = 0, blocks
            if high <= likely:
                first_block = min(reach[0], earlier[0]) // LANES
                end = (max(reach[1], earlier[1]) + LANES - 1) // LANES
                last_block = min(end, blocks)
            spiked = 0
            # These words are numbered, not drawn one after the other: whoever is out of reach
            # can leave its own out.
            halving = state + np.uint64(first_block * law.halvings) * STEP
            state += np.uint64(blocks * law.halvings) * STEP
            for block in range(first_block, last_block):
                found = above(cells.u, block * LANES, np.int32(likely))
                for _ in range(law.halvings):
                    found &= word(halving)
                    halving += STEP
                while found != _ZERO:
                    k = block * LANES + lowest_bit(found)
                    found &= found - _ONE
                    # Written in any case, and kept by whoever spikes: to guess would be slower.
                    cells.ring[slot, spiked] = k
                    spiked += share * uniform(state) < _probability(
                        law, slope, cells.u[k] + common, t - cells.last[k]
                    )
                    state += STEP
            while to_pass < neurons:
                k = to_pass
                silent = law.absolute and t - cells.last[k] <= tau
                if cells.u[k] <= likely and not silent:
                    cells.ring[slot, spiked] = k
                    spiked += law.rare * uniform(state) < _probability(
                        law, slope, cells.u[k] + common, t - cells.last[k]
                    )
                to_pass += 1 + gap(state + STEP, passing)
                state += STEP + STEP
            cells.spiked[slot] = spiked
            to_pass -= neurons
    return spikes, activity


@numba.njit(cache=True, error_model='numpy')
def _context_cells(theta, tau):
    groups = (len(theta) + LANES - 1) // LANES
    wanted = np.full(groups, ~_ZERO)
    wanted[-1] >>= np.uint64(groups * LANES - len(theta))
    high = np.array([theta[j].max() for j in range(len(theta))], dtype=np.int64)
    fired = np.empty((groups, tau + 1), dtype=np.uint64)
    return _ContextCells(theta, high, wanted, fired, np.empty(groups, dtype=np.uint64))


@numba.njit(cache=True, error_model='numpy', forceinline=True)
def _begin(synapses, cells, history, positions, activity, law):
    """Take in what was before step 0; return how many are active, and whom they reach."""
    tau, dimensions = law.tau, positions.shape[1]
    active, reach = 0, (len(history), 0)
    cells.spiked[:] = 0
    for k in range(len(history)):
        last = history[k]
        cells.last[k] = last
        if last >= -tau:
            slot = last + tau + 1
            cells.ring[slot, cells.spiked[slot]] = k
            cells.spiked[slot] += 1
            for j in range(dimensions):
                activity[tau + last, j] += positions[k, j]
            activity[tau + last, dimensions] += 1.0
            _add(synapses, k, cells.u)
            reach = _reached(synapses, k, reach)
            active += 1
            if law.absolute:
                cells.u[k] -= SILENT
    return active, reach


@numba.njit(cache=True, error_model='numpy', forceinline=True)
def _take_in(synapses, cells, law, t, slot, active, reach):
    """Begin the potentials of those that spiked at t; return who is active and in reach."""
    for n in range(cells.spiked[slot]):
        k = cells.ring[slot, n]
        reach = _reached(synapses, k, reach)
        if t - cells.last[k] > law.tau:
            _add(synapses, k, cells.u)
            active += 1
            if law.absolute:
                cells.u[k] -= SILENT
        cells.last[k] = t
    return active, reach


@numba.njit(cache=True, error_model='numpy', forceinline=True)
def _end(synapses, cells, law, t, slot, active):
    """End the potentials of those that have not spiked since t - tau - 1."""
    for n in range(cells.spiked[slot]):
        k = cells.ring[slot, n]
        if t - cells.last[k] == law.tau + 1:
            _take(synapses, k, cells.u)
            active -= 1
            if law.absolute:
                cells.u[k] += SILENT
    return active


@numba.njit(cache=True, error_model='numpy', forceinline=True)
def _advance_context(context, u, slot, high, probability, state):
    """Advance y~ by a step, and draw who spikes in it; return the largest input it can give."""
    for group in range(len(context.active)):
        context.fired[group, slot] = _ZERO
        now = _ZERO
        for lag in range(np.uint64(context.fired.shape[1])):
            now |= context.fired[np.uint64(group), lag]
        context.fired[group, slot], state = bernoulli_word(
            state, probability, context.wanted[group]
        )
        changed = now ^ context.active[group]
        context.active[group] = now
        while changed != _ZERO:
            bit = lowest_bit(changed)
            changed &= changed - _ONE
            j = group * LANES + bit
            sign = np.int32(1 if (now >> np.uint64(bit)) & _ONE else -1)
            for i in range(np.uint64(context.theta.shape[1])):
                u[np.uint64(i)] += sign * context.theta[j, np.uint64(i)]
            high += sign * context.high[j]
    return high, state


@numba.njit(cache=True, error_model='numpy')
def _probability(law, slope, potential, since):
    """Return the probability of a spike of a neuron that is not silent: see `activation`."""
    exponent = max(potential * slope - law.threshold, LOWEST)
    probability = exp(min(exponent, law.saturated))
    return probability * since / law.tau if since <= law.tau else probability


@numba.njit(cache=True, error_model='numpy')
def _reached(synapses, k, reach):
    """Widen a range of neurons by those that neuron k reaches."""
    pattern = synapses.pattern[k]
    begin, after = synapses.first[pattern], synapses.first[pattern + 1]
    if begin == after:
        return reach
    end = k + synapses.start[after - 1] + synapses.values.shape[1]
    return min(reach[0], k + synapses.start[begin]), max(reach[1], end)


@numba.njit(cache=True, error_model='numpy')
def _add(synapses, k, u):
    pattern = synapses.pattern[k]
    for n in range(synapses.first[pattern], synapses.first[pattern + 1]):
        low, span = np.uint64(k + synapses.start[n]), synapses.values[n]
        for i in range(np.uint64(len(span))):
            u[low + np.uint64(i)] += span[np.uint64(i)]


@numba.njit(cache=True, error_model='numpy')
def _take(synapses, k, u):
    pattern = synapses.pattern[k]
    for n in range(synapses.first[pattern], synapses.first[pattern + 1]):
        low, span = np.uint64(k + synapses.start[n]), synapses.values[n]
        for i in range(np.uint64(len(span))):
            u[low + np.uint64(i)] -= span[np.uint64(i)]
