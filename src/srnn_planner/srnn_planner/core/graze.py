# SPDX-License-Identifier: Apache-2.0
"""How much of what is blocked a path meets."""

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.grid_mean import GridMean


def graze(
    paths: NDArray[np.float64],
    mean: GridMean,
    blockage: NDArray[np.float64],
    caution: float,
) -> NDArray[np.float64]:
    """Return the length of paths (S, T, d), weighted by the root of the blockage on them.

    The root, because the rim of what was touched is as solid as its middle: what has lost a
    tenth is to be avoided a third as much, not a tenth.

    Args:
        paths: (S, T, d) [units].
        mean: of the grid on which the next is given.
        blockage: (K,) of each neuron.
        caution: the worst on a path counts as if it lasted for this long [units].

    Returns:
        (S,) [units], 0 where all is free.

    """
    if not blockage.any():
        return np.zeros(len(paths))
    samples, steps, dimensions = paths.shape
    blocked = mean.at(blockage, np.ascontiguousarray(paths).reshape(-1, dimensions))
    return np.asarray(_met(paths, blocked.reshape(samples, steps), caution))


@numba.njit(cache=True, error_model='numpy')
def _met(paths, blocked, caution):
    samples, steps, dimensions = paths.shape
    met = np.zeros(samples)
    for s in range(samples):
        most = blocked[s, 0]
        for t in range(1, steps):
            square = 0.0
            for d in range(dimensions):
                square += (paths[s, t, d] - paths[s, t - 1, d]) ** 2
            met[s] += np.sqrt(square * blocked[s, t])
            most = max(most, blocked[s, t])
        met[s] += caution * np.sqrt(most)
    return met
