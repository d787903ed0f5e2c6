# SPDX-License-Identifier: Apache-2.0
"""The compiled replay: for the same spike trains bit for bit the weights of `plasticity`.

Encoding and learning are one: a random number is drawn only where a spike is possible, and
only what spiked is touched.
"""

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.plasticity import Experience
from srnn_planner.core.random_words import STEP, uniform


def replay(
    weights: NDArray[np.float32],
    experience: Experience,
    seeds: NDArray[np.uint64],
    tau: int,
) -> NDArray[np.float32]:
    """Learn R encodings of one experience, one after another.

    Args:
        weights: (n, n) w[pre, post] between the neurons of the experience; not changed.
        experience: probabilities and rates of the segment.
        seeds: (R,) where the random numbers of each encoding begin, see `random_words`.
        tau: refractory period and length of the postsynaptic potential [steps].

    Returns:
        The new weights (n, n), see `plasticity.replay`.

    """
    incoming = np.ascontiguousarray(weights.T, dtype=np.float64)
    _replay(incoming, experience.executed, experience.mental, experience.rates, seeds, tau)
    return np.ascontiguousarray(incoming.T, dtype=np.float32)


@numba.njit(cache=True, error_model='numpy')
def _replay(incoming, executed, mental, rates, seeds, tau):
    steps, neurons = executed.shape
    possible = _possible(executed), _possible(mental)
    learning = np.array([rates[:, i].any() for i in range(neurons)])
    spiked = np.empty((2, steps * neurons), dtype=np.int64)
    until = np.zeros((2, steps + 1), dtype=np.int64)
    last = np.empty((2, neurons), dtype=np.int64)
    difference = np.zeros(neurons)
    for r in range(len(seeds)):
        state = seeds[r]
        last[:] = -tau - 1
        for t in range(steps):
            for way in range(2):
                first, among, probability = possible[way]
                count = until[way, t]
                for n in range(first[t], first[t + 1]):
                    i = among[n]
                    if t - last[way, i] > tau:
                        if uniform(state) < probability[n]:
                            last[way, i] = t
                            spiked[way, count] = i
                            difference[i] += 1.0 - 2.0 * way
                            count += 1
                        state += STEP
                until[way, t + 1] = count
            for way in range(2):
                for n in range(until[way, t], until[way, t + 1]):
                    i = spiked[way, n]
                    change = rates[t, i] * difference[i]
                    # Who spiked in both has no difference, and nobody learns twice.
                    difference[i] = 0.0
                    if change != 0.0:
                        for m in range(until[0, max(t - tau, 0)], until[0, t]):
                            incoming[i, spiked[0, m]] += change
        for i in range(neurons):
            if learning[i]:
                for k in range(neurons):
                    incoming[i, k] = min(1.0, max(-1.0, incoming[i, k]))


@numba.njit(cache=True, error_model='numpy')
def _possible(probability):
    """Return which neurons can spike in each step, as first (T + 1,), neurons and chances."""
    steps, neurons = probability.shape
    first = np.zeros(steps + 1, dtype=np.int64)
    among = np.empty(steps * neurons, dtype=np.int64)
    chance = np.empty(steps * neurons)
    count = 0
    for t in range(steps):
        for i in range(neurons):
            if probability[t, i] > 0.0:
                among[count] = i
                chance[count] = probability[t, i]
                count += 1
        first[t + 1] = count
    return first, among, chance
