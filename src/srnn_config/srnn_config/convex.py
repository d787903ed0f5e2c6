# SPDX-License-Identifier: Apache-2.0
"""Which outlines are convex polygons."""

from math import pi

import numpy as np
from numpy.typing import NDArray

MUST = (
    'must go once round a convex polygon; describe other shapes by several convex obstacles'
)
"""What an outline that `is_convex` refuses is told."""


def is_convex(points: NDArray[np.float64]) -> bool:
    """Tell whether walking round points (n, 2) turns one way, once."""
    edges = np.roll(points, -1, axis=0) - points
    following = np.roll(edges, -1, axis=0)
    cross = edges[:, 0] * following[:, 1] - edges[:, 1] * following[:, 0]
    turns = np.arctan2(cross, (edges * following).sum(axis=1))
    turns *= 1.0 if turns.sum() > 0.0 else -1.0
    return bool(turns.min() >= 0.0 and turns.max() <= 0.99 * pi and turns.sum() <= 2.5 * pi)
