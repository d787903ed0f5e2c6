# SPDX-License-Identifier: Apache-2.0
"""What was learned, one version against another: undone, and put together."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.errors import WeightsError
from srnn_planner.core.grid import Indices
from srnn_planner.core.synapses import Synapses

Learned = tuple[Synapses, Synapses]
"""Weights before and after."""


@dataclass(frozen=True, eq=False)
class Change:
    """How weights differ from earlier ones.

    Attributes:
        synapses: how many of them differ.
        largest: the largest difference, by size.
        centre: (d,) where the neurons are whose input has changed, on average [units];
            not finite if none has.

    """

    synapses: int
    largest: float
    centre: NDArray[np.float64]


def change(before: Synapses, after: Synapses) -> Change:
    """Return how weights have changed.

    Raises:
        WeightsError: they are of different networks.

    """
    _check(before, after)
    touched = _touched(before, after)
    difference = after.at(touched).astype(np.float64) - before.at(touched)
    size = np.abs(difference)
    grid = before.prior.grid
    places = 2.0 / (grid.side - 1) * grid.coordinates[touched % grid.count] - 1.0
    total = size.sum()
    centre = size @ places / total if total else np.full(grid.dimensions, np.nan)
    largest = float(difference[size.argmax()]) if size.size else 0.0
    return Change(int((size > 0.0).sum()), largest, centre)


def undone(newest: Synapses, before: Synapses, after: Synapses) -> Synapses:
    """Return the newest weights without one update, which led from `before` to `after`.

    What came later stays: from every synapse the difference that the update made is taken
    away, within the limits of the weights. The last update is undone exactly.

    Raises:
        WeightsError: they are of different networks.

    """
    _check(newest, before, after)
    touched = _touched(newest, before, after)
    now, old, new = (synapses.at(touched) for synapses in (newest, before, after))
    difference = new.astype(np.float64) - old
    rest = np.clip(now - difference, -1.0, 1.0).astype(np.float32)
    weights = np.where(difference == 0.0, now, np.where(now == new, old, rest))
    return Synapses.beside(newest.prior, touched, weights)


def merged(one: Synapses, other: Synapses) -> Synapses:
    """Return what two runs have learned beside the same prior, together.

    Every synapse is taken from the run that has changed it more; of two that have changed it
    by as much, from the one that inhibits more. So it does not matter which is which, nothing
    is added by merging twice, and whoever has learned nothing changes nothing.

    Raises:
        WeightsError: they are of different networks.

    """
    _check(one, other)
    touched = _touched(one, other)
    prior = Synapses(one.prior).at(touched)
    a, b = one.at(touched), other.at(touched)
    first, second = np.abs(a - prior), np.abs(b - prior)
    taken = (first > second) | ((first == second) & (a <= b))
    return Synapses.beside(one.prior, touched, np.where(taken, a, b))


def correlation(one: Learned, other: Learned) -> float:
    """Return the correlation of what was learned in two runs, over all synapses.

    Args:
        one: weights before and after it, of a network with as many neurons as the other.
        other: the same of the other run.

    Returns:
        Between -1 and 1; not a number if one of them has learned nothing.

    """
    touched = _touched(*one, *other)
    a, b = (
        after.at(touched).astype(np.float64) - before.at(touched)
        for before, after in (one, other)
    )
    everywhere = float(one[0].prior.grid.count ** 2)
    covariance = a @ b / everywhere - a.sum() * b.sum() / everywhere**2
    variances = [x @ x / everywhere - (x.sum() / everywhere) ** 2 for x in (a, b)]
    product = float(np.prod(variances))
    return float(covariance / np.sqrt(product)) if product > 0.0 else float('nan')


def _check(*versions: Synapses) -> None:
    priors = sorted({f'{version.prior.checksum:#010x}' for version in versions})
    if len(priors) > 1:
        raise WeightsError(f'weights beside the priors {" and ".join(priors)}: must be one')


def _touched(*versions: Synapses) -> Indices:
    """Return the synapses (n,) that have learned in any of these versions."""
    return np.unique(np.concatenate([version.learned.synapses for version in versions]))
