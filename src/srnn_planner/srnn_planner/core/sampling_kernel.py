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

from srnn_planner.core.context import ContextPopulation
from srnn_planner.core.exponential import LOWEST, exp
from srnn_planner.core.intrinsics import lowest_bit
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.random_words import STEP, bernoulli_word, gap, uniform, word
from srnn_planner.core.synapse_spans import ROOM, SynapseSpans, synapse_spans

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
    limit: float
    absolute: bool
    halvings: int
    """The limit is at most 2 to the minus this."""
    saturated: float
    """Neurons above this spike with the limit of the probability."""
    rare: float
    """Neurons below `seldom` spike with at most this probability."""
    seldom: float


class Sampler:
    """Samples movements by running the network.

    Attributes:
        law: when a neuron spikes.
        synapses: the weights in use, once there are any.

    """

    def __init__(
        self,
        network: NetworkParameters,
        positions: NDArray[np.float64],
        bias: NDArray[np.float64],
        context_max: float,
    ) -> None:
        """Take what stays the same.

        Args:
            network: the network's parameters.
            positions: (K, d) preferred positions of the state neurons.
            bias: (K,) input of context neurons that spike all the time, at most 0.
            context_max: largest input that all other context neurons give together.

        """
        rare = 0.5 ** np.ceil(np.log2(2.0 * len(positions)))
        self.law = Law(
            network.tau, network.slope, network.threshold, network.spike_probability_max,
            network.refractory == 'absolute',
            int(np.floor(-np.log2(network.spike_probability_max))),
            float(np.log(network.spike_probability_max)), rare,
            (network.threshold + np.log(rare)) / network.slope,
        )  # fmt: skip
        self._offset = network.weight_offset
        self._positions = positions
        self._bias = bias
        self._others = float(np.abs(bias).max()) + context_max + abs(self.law.seldom)
        self.synapses: SynapseSpans

    def use_weights(self, weights: NDArray[np.float32]) -> None:
        """Run the network with weights (K, K) from now on."""
        self.synapses = synapse_spans(weights, self._offset, self._others)

    def sample(
        self,
        context: ContextPopulation,
        history: NDArray[np.int32],
        seeds: NDArray[np.uint64],
    ) -> tuple[NDArray[np.uint16], NDArray[np.float64]]:
        """Run the network S times for T steps.

        Args:
            context: the active context population over T steps.
            history: (S, K) step of each neuron's last spike before 0, see `draw_history`.
            seeds: (S,) where the random numbers of each sample begin, see `random_words`.

        Returns:
            spikes: (T, K) how many of the samples spiked.
            activity: (S, tau + T, d + 1) for each step, history included, the sum of the
                positions of the neurons that spiked and, last, their number.

        """
        synapses = self.synapses
        inputs = np.rint(context.weights * synapses.scale).astype(np.int32)
        spikes_and_activity: tuple[NDArray[np.uint16], NDArray[np.float64]] = _sample(
            synapses.first, synapses.start, synapses.values, synapses.rest, synapses.scale,
            np.rint(self._bias * synapses.scale).astype(np.int32), inputs,
            context.spike_probability, history, seeds, self._positions, self.law,
        )  # fmt: skip
        return spikes_and_activity


@numba.njit(cache=True, error_model='numpy')
def _sample(
    first, start, values, rest, scale, bias, theta, context_probability, history, seeds,
    positions, law,
):  # fmt: skip
    samples, neurons = history.shape
    steps, tau = len(context_probability), law.tau
    dimensions = positions.shape[1]
    blocks = (neurons + LANES - 1) // LANES
    spikes = np.zeros((steps, neurons), dtype=np.uint16)
    activity = np.zeros((samples, tau + steps, dimensions + 1))
    # Spans may end beyond the last neuron.
    u = np.full(blocks * LANES + values.shape[1], -SILENT, dtype=np.int32)
    last = np.empty(neurons, dtype=np.int32)
    # Neurons by the step of their spike, modulo tau + 1: those whose potential ends next.
    ring = np.empty((tau + 1, neurons), dtype=np.int32)
    ring_count = np.zeros(tau + 1, dtype=np.int64)
    met = np.empty(blocks * LANES, dtype=np.int32)
    groups = (len(theta) + LANES - 1) // LANES
    fired = np.empty((groups, tau + 1), dtype=np.uint64)
    context = np.empty(groups, dtype=np.uint64)
    wanted = np.full(groups, ~_ZERO)
    wanted[-1] >>= np.uint64(groups * LANES - len(theta))
    context_high = np.array([theta[j].max() for j in range(len(theta))], dtype=np.int64)
    bias_high = np.int64(bias.max())
    seldom = np.int64(np.ceil(law.seldom * scale))
    slope = law.slope / scale
    share, passing = 0.5**law.halvings, 1.0 / np.log1p(-law.rare)
    for s in range(samples):
        state = seeds[s]
        u[:neurons] = bias
        ring_count[:] = 0
        context[:] = fired[:] = _ZERO
        active, high = 0, bias_high
        # Who was active in the last tau + 1 steps spiked in the last two stretches of as many.
        low, end, earlier_low, earlier_end = neurons, 0, neurons, 0
        for k in range(neurons):
            last[k] = history[s, k]
            if last[k] >= -tau:
                slot = last[k] + tau + 1
                ring[slot, ring_count[slot]] = k
                ring_count[slot] += 1
                for j in range(dimensions):
                    activity[s, tau + last[k], j] += positions[k, j]
                activity[s, tau + last[k], dimensions] += 1.0
                _add(first, start, values, k, u)
                earlier_low, earlier_end = _reach(
                    first, start, values, k, earlier_low, earlier_end
                )
                active += 1
                if law.absolute:
                    u[k] -= SILENT
        to_pass = gap(state, passing)
        state += STEP
        slot = -1
        for t in range(steps + 1):
            for n in range(ring_count[slot] if t > 0 else 0):
                k = ring[slot, n]
                spikes[t - 1, k] += 1
                for j in range(dimensions):
                    activity[s, tau + t - 1, j] += positions[k, j]
                low, end = _reach(first, start, values, k, low, end)
                if t - 1 - last[k] > tau:
                    _add(first, start, values, k, u)
                    active += 1
                    if law.absolute:
                        u[k] -= SILENT
                last[k] = t - 1
            if t > 0:
                activity[s, tau + t - 1, dimensions] = ring_count[slot]
            if t == steps:
                break
            slot += 1
            if slot > tau:
                slot, earlier_low, earlier_end, low, end = 0, low, end, neurons, 0
            for n in range(ring_count[slot]):
                k = ring[slot, n]
                if t - last[k] == tau + 1:
                    _take(first, start, values, k, u)
                    active -= 1
                    if law.absolute:
                        u[k] += SILENT
            for group in range(groups):
                # Of y~ the spikes of the step before begin, those of t - tau - 1 end.
                fired[group, slot] = _ZERO
                now = _ZERO
                for lag in range(tau + 1):
                    now |= fired[group, lag]
                fired[group, slot], state = bernoulli_word(
                    state, context_probability[t], wanted[group]
                )
                changed = now ^ context[group]
                context[group] = now
                while changed != _ZERO:
                    j = lowest_bit(changed)
                    changed &= changed - _ONE
                    ends = (now >> np.uint64(j)) & _ONE == _ZERO
                    j += group * LANES
                    high += _switch(u, theta, j, context_high[j], ends)
            common = active * rest
            likely = min(seldom - common, np.int64(ROOM))
            if high > likely:
                first_block, last_block = 0, blocks
            else:
                first_block = min(low, earlier_low) // LANES
                last_block = min((max(end, earlier_end) + LANES - 1) // LANES, blocks)
            count = 0
            for block in range(first_block, last_block):
                above = _above(u, np.int32(likely), block)
                if above == _ZERO:
                    continue
                for _ in range(law.halvings):
                    above &= word(state)
                    state += STEP
                while above != _ZERO:
                    met[count] = block * LANES + lowest_bit(above)
                    count += 1
                    above &= above - _ONE
            spiked = 0
            for n in range(count):
                k = met[n]
                # Written in any case, and kept by whoever spikes: to guess would be slower.
                ring[slot, spiked] = k
                spiked += share * uniform(state) < _probability(
                    law, slope, u[k] + common, t - last[k]
                )
                state += STEP
            while to_pass < neurons:
                k = to_pass
                if u[k] <= likely and not (law.absolute and t - last[k] <= tau):
                    ring[slot, spiked] = k
                    spiked += law.rare * uniform(state) < _probability(
                        law, slope, u[k] + common, t - last[k]
                    )
                to_pass += 1 + gap(state + STEP, passing)
                state += STEP + STEP
            ring_count[slot] = spiked
            to_pass -= neurons
    return spikes, activity


@numba.njit(cache=True, error_model='numpy')
def _probability(law, slope, potential, since):
    """Return the probability of a spike of a neuron that is not silent: see `activation`."""
    exponent = max(potential * slope - law.threshold, LOWEST)
    probability = exp(min(exponent, law.saturated))
    return probability * since / law.tau if since <= law.tau else probability


@numba.njit(cache=True, error_model='numpy')
def _above(u, likely, block):
    """Return a word with a bit for each neuron of a block whose potential is above a value."""
    found = _ZERO
    lanes = u[block * LANES : block * LANES + LANES]
    for j in range(LANES):
        found |= np.uint64(lanes[j] > likely) << np.uint64(j)
    return found


@numba.njit(cache=True, error_model='numpy')
def _reach(first, start, values, k, low, end):
    """Widen a range of neurons by those that neuron k reaches."""
    begin, after = first[k], first[k + 1]
    if begin == after:
        return low, end
    return min(low, start[begin]), max(end, start[after - 1] + values.shape[1])


@numba.njit(cache=True, error_model='numpy')
def _add(first, start, values, k, u):
    for n in range(first[k], first[k + 1]):
        # Unsigned, or numba makes room for indices that count from the end.
        low, span = np.uint64(start[n]), values[n]
        for i in range(np.uint64(len(span))):
            u[low + np.uint64(i)] += span[np.uint64(i)]


@numba.njit(cache=True, error_model='numpy')
def _take(first, start, values, k, u):
    for n in range(first[k], first[k + 1]):
        low, span = np.uint64(start[n]), values[n]
        for i in range(np.uint64(len(span))):
            u[low + np.uint64(i)] -= span[np.uint64(i)]


@numba.njit(cache=True, error_model='numpy')
def _switch(u, theta, j, high, ends):
    """Begin or end the input of context neuron j; return the change of the largest one."""
    sign = np.int32(-1 if ends else 1)
    for i in range(np.uint64(theta.shape[1])):
        u[np.uint64(i)] += sign * theta[j, np.uint64(i)]
    return -high if ends else high
