# SPDX-License-Identifier: Apache-2.0
"""Which samples lead on without grazing what is blocked."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.parameters import SelectionParameters
from srnn_planner.core.state_neurons import StateNeurons


def expected_cost(
    paths: NDArray[np.float64],
    neurons: StateNeurons,
    remaining: NDArray[np.float64],
    blockage: NDArray[np.float64],
    aversion: float,
    caution: float,
) -> NDArray[np.float64]:
    """Return what it costs to go each way (S, T, d), and from its end to the target.

    The way itself costs nothing where it is free: a sample that stays where it is
    should not look better than one that gets on.

    Args:
        paths: (S, T, d) decoded samples [units].
        neurons: the grid on which the next two are given.
        remaining: (K,) length of the way from each neuron to the target [units].
        blockage: (K,) of each neuron.
        aversion: a way through blockage 1 costs this many times its length.
        caution: the worst blockage counts as if it lasted for this long [units].

    Returns:
        (S,) [units].

    """
    samples, steps, dimensions = paths.shape
    met = neurons.interpolate(blockage, paths.reshape(-1, dimensions)).reshape(samples, steps)
    travelled = np.linalg.norm(np.diff(paths, axis=1), axis=2)
    through = (travelled * met[:, 1:]).sum(axis=1) + caution * met.max(axis=1)
    return np.asarray(neurons.interpolate(remaining, paths[:, -1]) + aversion * through)


def promising(
    cost: NDArray[np.float64], parameters: SelectionParameters
) -> NDArray[np.bool_]:
    """Return the mask (S,) of the cheapest share of the samples."""
    count = max(1, round(parameters.promising * len(cost)))
    return np.asarray(cost <= np.partition(cost, count - 1)[count - 1])
