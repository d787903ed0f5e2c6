# SPDX-License-Identifier: Apache-2.0
"""Compiled means by responsibilities: what `StateNeurons.interpolate` returns.

Along each dimension of the grid a Gaussian at equal distances is a product: one exponential
gives it at all neurons. Neurons far away have no share that counts.
"""

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.elementary import LOWEST, exp
from srnn_planner.core.parameters import NetworkParameters

NEGLIGIBLE = 1e-8
"""Neurons with a smaller share than this, of the nearest one's, are left out."""


class GridMean:
    """Takes means of values on a grid of neurons, around any point."""

    def __init__(self, network: NetworkParameters) -> None:
        """Take the grid, `NetworkParameters.neurons_per_dimension` neurons to each side."""
        side = network.neurons_per_dimension
        spacing = 2.0 / (side - 1)
        steepness = spacing / network.sigma
        # A point is half a spacing from its nearest neuron at most: r^2 - r half squares left.
        reach = 0.5 + np.sqrt(0.25 - 2.0 * np.log(NEGLIGIBLE) / steepness**2)
        offsets = np.arange(min(int(np.ceil(reach)), side - 1) + 1)
        self._fall = np.exp(-0.5 * (offsets * steepness) ** 2)
        self._grid = side, spacing, steepness / network.sigma

    def at(
        self, values: NDArray[np.float64], points: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the mean of values (K,) by the responsibilities of points (n, d), as (n,)."""
        mean: NDArray[np.float64] = _means(values, points, self._fall, self._grid)
        return mean


@numba.njit(cache=True, error_model='numpy')
def _means(values, points, fall, grid):
    count, dimensions = points.shape
    means = np.zeros(count)
    # A grid of fewer dimensions has one neuron along the others, in front.
    skipped = 3 - dimensions
    box_low, box_end = _box(values, grid[0], skipped)
    share = np.ones((3, 2 * len(fall) - 1))
    first = np.zeros(3, dtype=np.int64)
    low, end = np.zeros(3, dtype=np.int64), np.ones(3, dtype=np.int64)
    for n in range(count):
        inside = True
        for axis in range(skipped, 3):
            nearest = _nearest(points[n, axis - skipped], grid)
            first[axis] = max(nearest - len(fall) + 1, 0)
            low[axis] = max(first[axis], box_low[axis])
            end[axis] = min(nearest + len(fall), grid[0], box_end[axis])
            inside &= low[axis] < end[axis]
        # Of what is blocked most is far away.
        if inside:
            whole = 1.0
            for axis in range(skipped, 3):
                x = points[n, axis - skipped]
                whole *= _share(x, fall, grid, first[axis], share[axis])
            means[n] = _mean(values, share, first, low, end, grid[0]) / whole
    return means


@numba.njit(cache=True, error_model='numpy')
def _box(values, side, skipped):
    """Return the first index and that after the last along each axis where values are not 0."""
    low, end = np.full(3, side), np.zeros(3, dtype=np.int64)
    for k in range(len(values)):
        if values[k] != 0.0:
            left = k
            for axis in range(2, skipped - 1, -1):
                index = left % side
                low[axis], end[axis] = min(low[axis], index), max(end[axis], index + 1)
                left //= side
    return low, end


@numba.njit(cache=True, error_model='numpy')
def _nearest(x, grid):
    return min(max(int(np.rint((x + 1.0) / grid[1])), 0), grid[0] - 1)


@numba.njit(cache=True, error_model='numpy')
def _share(x, fall, grid, first, share):
    """Write the basis of the neurons along one dimension, from the first on; return its sum."""
    side, spacing, steepness = grid
    nearest = _nearest(x, grid)
    middle = nearest - first
    # exp(-(a - j h)^2 / 2 s^2), relative to j = 0, is exp(a h / s^2)^j exp(-(j h)^2 / 2 s^2).
    exponent = (x - (nearest * spacing - 1.0)) * steepness
    up = exp(max(-abs(exponent), LOWEST))
    down = 1.0 / up
    if exponent > 0.0:
        up, down = down, up
    share[middle] = total = power = 1.0
    for j in range(1, min(len(fall), side - nearest)):
        power *= up
        share[middle + j] = power * fall[j]
        total += share[middle + j]
    power = 1.0
    for j in range(1, middle + 1):
        power *= down
        share[middle - j] = power * fall[j]
        total += share[middle - j]
    return total


@numba.njit(cache=True, error_model='numpy')
def _mean(values, share, first, low, end, side):
    total = 0.0
    for i in range(low[0], end[0]):
        plane = 0.0
        for j in range(low[1], end[1]):
            line, begin = 0.0, (i * side + j) * side
            for k in range(low[2], end[2]):
                line += share[2, k - first[2]] * values[begin + k]
            plane += share[1, j - first[1]] * line
        total += share[0, i - first[0]] * plane
    return total
