# SPDX-License-Identifier: Apache-2.0
"""The compiled replay: bit for bit the weights of `plasticity.replay`."""

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.plasticity import Experience


def replay(
    weights: NDArray[np.float32],
    experience: Experience,
    uniforms: NDArray[np.float32],
    tau: int,
) -> NDArray[np.float32]:
    """Learn R encodings of one experience; see `plasticity.replay`."""
    return _replay(
        weights, experience.executed, experience.mental, experience.rates, uniforms, tau
    )


@numba.njit(cache=True)
def _replay(weights, executed, mental, rates, uniforms, tau):
    replays, _, steps, neurons = uniforms.shape
    updated = weights.astype(np.float64)
    executed_last = np.empty(neurons, dtype=np.int64)
    mental_last = np.empty(neurons, dtype=np.int64)
    potential = np.empty(neurons, dtype=np.int64)
    for r in range(replays):
        executed_last[:] = -tau - 1
        mental_last[:] = -tau - 1
        for t in range(steps):
            active = 0
            for k in range(neurons):
                if t - executed_last[k] <= tau:
                    potential[active] = k
                    active += 1
            for i in range(neurons):
                difference = 0.0
                if uniforms[r, 0, t, i] < executed[t, i] and t - executed_last[i] > tau:
                    executed_last[i] = t
                    difference += 1.0
                if uniforms[r, 1, t, i] < mental[t, i] and t - mental_last[i] > tau:
                    mental_last[i] = t
                    difference -= 1.0
                if difference != 0.0 and rates[t, i] != 0.0:
                    change = rates[t, i] * difference
                    for n in range(active):
                        updated[potential[n], i] += change
        for k in range(neurons):
            for i in range(neurons):
                updated[k, i] = min(1.0, max(-1.0, updated[k, i]))
    return updated.astype(np.float32)
