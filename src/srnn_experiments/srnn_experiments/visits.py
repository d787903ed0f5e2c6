# SPDX-License-Identifier: Apache-2.0
"""How long visits of a way point take, those that never ended included."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Visits(NamedTuple):
    """The visits of one way point in one trial.

    Attributes:
        completed: segments that each visit took, in order.
        open: segments spent on the visit that the end of the trial cut off, 0 for none.

    """

    completed: list[int]
    open: int


def visit_lengths(active: Sequence[int], reached: Sequence[Any], index: int) -> Visits:
    """Return the visits of way point `index`.

    Args:
        active: way point of every segment.
        reached: whether the segment ended at it.
        index: way point that counts.

    """
    completed, count = [], 0
    for target, arrived in zip(active, reached, strict=True):
        if target != index:
            continue
        count += 1
        if arrived:
            completed.append(count)
            count = 0
    return Visits(completed, count)


def spent_per_visit(
    spent: NDArray[np.float64], completed: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how many segments were spent for each completed visit, infinite without any.

    Segments of visits that were cut off count as spent, so that a trial that never arrives
    does not look better than one that does: the estimate of a mean from observations that
    were cut off, events over exposure, upside down.

    Args:
        spent: (...) segments spent on the way to the way point.
        completed: (...) visits completed.

    """
    visits = np.asarray(completed, dtype=np.float64)
    return np.where(visits > 0.0, spent / np.maximum(visits, 1.0), np.inf)
