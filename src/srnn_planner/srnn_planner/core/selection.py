# SPDX-License-Identifier: Apache-2.0
"""Sample rejection: only movements of one kind may be averaged."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.mode_means import mode_means
from srnn_planner.core.nearest_directions import nearest_directions
from srnn_planner.core.parameters import SelectionParameters

Judged = Callable[[NDArray[np.float64]], NDArray[np.float64]]

BATCH = 40
"""Modes judged at a time: so many first, twice as many then, and so on."""


class Cost(NamedTuple):
    """Expected cost of paths, in two parts.

    Attributes:
        least: returns (S,) what paths (S, T, d) cost at least.
        more: returns (S,) what they cost beyond that, at least 0; takes longer to find out.

    """

    least: Judged
    more: Judged


def select(
    paths: NDArray[np.float64], parameters: SelectionParameters, cost: Cost
) -> NDArray[np.bool_]:
    """Return the mask (S,) of the samples (S, T, d) to average, by the rule of that name."""
    displacement = paths[:, -1] - paths[:, 0]
    if parameters.rule == 'three_sigma':
        return three_sigma(displacement, parameters.majority)
    if parameters.rule == 'mode_seeking':
        return mode_seeking(displacement, parameters.mode_share)
    return best_mode(paths, parameters.mode_share, cost)


def three_sigma(displacement: NDArray[np.float64], majority: float) -> NDArray[np.bool_]:
    """Keep the samples whose direction is close to that of a reference sample.

    The reference is the sample with the least mean angle to the closest `majority`
    of the population; kept are those within mean + 3 standard deviations of these
    angles (Tanneberg et al. 2019, "Online Motion Planning Framework").

    Args:
        displacement: (S, d) last minus first point of each sample.
        majority: share of the population, 0.9 in the paper.

    """
    angle = pairwise_angles(displacement)
    closest = _closest(angle, majority)
    reference = int(np.argmin(closest.mean(axis=1)))
    near = closest[reference]
    return np.asarray(angle[reference] <= near.mean() + 3.0 * near.std())


def mode_seeking(displacement: NDArray[np.float64], share: float) -> NDArray[np.bool_]:
    """Keep the densest mode: a reference sample and its nearest `share` of the samples.

    The reference has the least mean angle to its nearest `share`. Two ways round an
    obstacle are two modes, whose mean would go nowhere. Directions are compared, not
    displacements: among these the samples that hardly move are the densest mode, and
    the arm would dither where it has to find a way.

    Args:
        displacement: (S, d) last minus first point of each sample.
        share: share of the population that forms the mode.

    """
    angle = pairwise_angles(displacement)
    reference = int(np.argmin(_closest(angle, share).mean(axis=1)))
    kept = np.zeros(len(displacement), dtype=bool)
    kept[np.argsort(angle[reference], kind='stable')[: _count(len(angle), share)]] = True
    return kept


def best_mode(
    paths: NDArray[np.float64], share: float, cost: Cost
) -> NDArray[np.bool_]:
    """Keep the mode whose mean costs least: some sample and its nearest `share`.

    It is the mean that the arm will follow. Where nothing is blocked it leads on most.

    Args:
        paths: (S, T, d) samples.
        share: share of the population that forms a mode.
        cost: what to expect of a path.

    """
    modes = nearest_directions(paths[:, -1] - paths[:, 0], _count(len(paths), share))
    kept = np.zeros(len(paths), dtype=bool)
    kept[modes[_cheapest(mode_means(paths, modes), cost)]] = True
    return kept


def _cheapest(paths: NDArray[np.float64], cost: Cost) -> int:
    """Return the first of the paths (n, T, d) that cost least, without judging all of them."""
    least = cost.least(paths)
    order = np.argsort(least, kind='stable')
    lowest, cheapest = np.inf, 0
    first, size = 0, BATCH
    while first < len(order) and least[order[first]] <= lowest:
        batch = order[first : first + size]
        first, size = first + size, 2 * size
        total = least[batch] + cost.more(paths[batch])
        best = np.lexsort((batch, total))[0]
        lowest, cheapest = min((lowest, cheapest), (float(total[best]), int(batch[best])))
    return cheapest


def pairwise_angles(displacement: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the angles (S, S) between displacements (S, d) [rad]."""
    length = np.linalg.norm(displacement, axis=1, keepdims=True)
    unit = displacement / np.maximum(length, 1e-12)
    cosine = np.clip(unit @ unit.T, -1.0, 1.0)
    np.fill_diagonal(cosine, 1.0)
    return np.asarray(np.arccos(cosine))


def _closest(distance: NDArray[np.float64], share: float) -> NDArray[np.float64]:
    return np.asarray(np.sort(distance, axis=1)[:, : _count(len(distance), share)])


def _count(samples: int, share: float) -> int:
    return max(1, min(samples, round(share * samples)))
