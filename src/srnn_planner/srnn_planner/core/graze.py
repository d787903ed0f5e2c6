# SPDX-License-Identifier: Apache-2.0
"""How much of what is blocked a path meets."""

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
    samples, steps, dimensions = paths.shape
    if not blockage.any():
        return np.zeros(samples)
    blocked = mean.at(blockage, paths.reshape(-1, dimensions))
    met = np.sqrt(blocked).reshape(samples, steps)
    travelled = np.linalg.norm(np.diff(paths, axis=1), axis=2)
    return np.asarray((travelled * met[:, 1:]).sum(axis=1) + caution * met.max(axis=1))
