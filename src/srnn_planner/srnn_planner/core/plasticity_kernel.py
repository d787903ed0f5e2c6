# SPDX-License-Identifier: Apache-2.0
"""The compiled replay: bit for bit the weights of `plasticity.replay`.

Only neurons that can spike are looked at, and only weights to neurons that learn.
"""

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
    executed, mental, rates = experience.executed, experience.mental, experience.rates
    spiking = np.flatnonzero(((executed > 0.0) | (mental > 0.0)).any(axis=0))
    learning = np.flatnonzero(rates.any(axis=0))
    incoming = weights[:, learning].T.astype(np.float64)
    _replay(incoming, learning, spiking, executed, mental, rates, uniforms, tau)
    updated = weights.copy()
    updated[:, learning] = incoming.T
    return updated


@numba.njit(cache=True)
def _replay(incoming, learning, spiking, executed, mental, rates, uniforms, tau):
    replays, _, steps, neurons = uniforms.shape
    executed_last = np.empty(neurons, dtype=np.int64)
    mental_last = np.empty(neurons, dtype=np.int64)
    potential = np.empty(neurons, dtype=np.int64)
    row = np.full(neurons, -1)
    row[learning] = np.arange(len(learning))
    for r in range(replays):
        executed_last[:] = -tau - 1
        mental_last[:] = -tau - 1
        for t in range(steps):
            active = 0
            for k in spiking:
                if t - executed_last[k] <= tau:
                    potential[active] = k
                    active += 1
            for i in spiking:
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
                        incoming[row[i], potential[n]] += change
        for n in range(len(learning)):
            for k in spiking:
                incoming[n, k] = min(1.0, max(-1.0, incoming[n, k]))
