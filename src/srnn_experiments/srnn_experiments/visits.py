# SPDX-License-Identifier: Apache-2.0
"""How long visits of a way point take, and what is known of those that never ended."""

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


def unfinished(ended: NDArray[np.float64], cut_off: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the share of visits that take more than n segments, for n = 1 to N.

    The product-limit estimate (Kaplan and Meier 1958): a visit that was cut off counts as
    long as it was seen, and neither as completed nor as endless.

    Args:
        ended: (..., N) number of visits completed by their nth segment.
        cut_off: (..., N) number of visits cut off after their nth segment.

    Returns:
        (..., N) shares, 1 where nothing is known.

    """
    gone = ended + cut_off
    at_risk = np.cumsum(gone[..., ::-1], axis=-1)[..., ::-1]
    return np.asarray(np.cumprod(1.0 - ended / np.where(at_risk > 0.0, at_risk, 1.0), axis=-1))


def median_length(share: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return after how many segments half of the visits are completed.

    Args:
        share: (..., N) from `unfinished`.

    Returns:
        (...) segments, infinite where more than half were never completed.

    """
    below = share <= 0.5
    return np.where(below.any(axis=-1), below.argmax(axis=-1) + 1.0, np.inf)
