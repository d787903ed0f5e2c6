# SPDX-License-Identifier: Apache-2.0
"""What was learned, one version against another: undone, and put together."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.errors import WeightsError

Weights = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Change:
    """How weights differ from earlier ones.

    Attributes:
        synapses: how many of them differ.
        largest: the largest difference, by size.
        centre: (d,) where the neurons are whose input has changed, on average [their units];
            not finite if none has.

    """

    synapses: int
    largest: float
    centre: NDArray[np.float64]


def change(before: Weights, after: Weights, positions: NDArray[np.float64]) -> Change:
    """Return how weights (K, K) have changed; `positions` (K, d) are those of the neurons.

    Raises:
        WeightsError: they are of networks of different size.

    """
    _check(before, after)
    difference = after.astype(np.float64) - before
    size = np.abs(difference)
    received = size.sum(axis=0)
    total = received.sum()
    centre = received @ positions / total if total else np.full(positions.shape[1], np.nan)
    largest = float(difference.flat[size.argmax()]) if size.size else 0.0
    return Change(int((size > 0.0).sum()), largest, centre)


def undone(newest: Weights, before: Weights, after: Weights) -> Weights:
    """Return the newest weights (K, K) without one update, which led from `before` to `after`.

    What came later stays: from every synapse the difference that the update made is taken
    away, within the limits of the weights. The last update is undone exactly.

    Raises:
        WeightsError: they are of networks of different size.

    """
    _check(newest, before, after)
    difference = after.astype(np.float64) - before
    rest = np.clip(newest - difference, -1.0, 1.0).astype(np.float32)
    untouched = difference == 0.0
    return np.where(untouched, newest, np.where(newest == after, before, rest))


def merged(prior: Weights, one: Weights, other: Weights) -> Weights:
    """Return what two runs have learned (K, K), from the same beginning, together.

    Every synapse is taken from the run that has changed it more; of two that have changed it
    by as much, from the one that inhibits more. So it does not matter which is which, nothing
    is added by merging twice, and whoever has learned nothing changes nothing.

    Raises:
        WeightsError: they are of networks of different size.

    """
    _check(prior, one, other)
    first, second = np.abs(one - prior), np.abs(other - prior)
    taken = (first > second) | ((first == second) & (one <= other))
    return np.where(taken, one, other)


def _check(*weights: Weights) -> None:
    shapes = {matrix.shape for matrix in weights}
    if len(shapes) > 1:
        sizes = ' and '.join(sorted(str(shape) for shape in shapes))
        raise WeightsError(f'weights of shape {sizes} are of different networks')
