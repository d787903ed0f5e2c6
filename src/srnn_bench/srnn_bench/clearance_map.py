# SPDX-License-Identifier: Apache-2.0
"""The distance from obstacles on a grid: looked up, not computed, while peers plan."""

from collections.abc import Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from srnn_config.geometry import clearance
from srnn_config.scene import EDGE, Obstacle

CELL = 0.001
"""Edge of a cell [m]."""

OFF_CENTRE = CELL / sqrt(2.0)
"""A point is no farther than this from the centre of its cell [m]."""


class ClearanceMap:
    """Distances (n, n) of the centres of all cells of the workspace from the obstacles [m]."""

    def __init__(self, obstacles: Sequence[Obstacle]) -> None:
        """Compute the distances."""
        axis = np.arange(-EDGE, EDGE + CELL / 2.0, CELL)
        points = np.stack(np.meshgrid(axis, axis, indexing='ij'), axis=2).reshape(-1, 2)
        self.distances = clearance(points, obstacles).reshape(len(axis), len(axis))

    def at(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the distances (...) of points (..., 2), those outside being on the edge."""
        cells = np.rint((points + EDGE) / CELL).astype(np.int64)
        cells = np.clip(cells, 0, len(self.distances) - 1)
        return self.distances[cells[..., 0], cells[..., 1]]
