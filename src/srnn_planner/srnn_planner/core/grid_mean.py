# SPDX-License-Identifier: Apache-2.0
"""Compiled means by responsibilities: what `StateNeurons.interpolate` returns.

Along each dimension of the grid a Gaussian at equal distances is a product: one exponential
gives it at all neurons. Neurons far away have no share that counts.
"""

import numba
import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.elementary import HIGHEST, LOWEST, exp
from srnn_planner.core.parameters import NetworkParameters

NEGLIGIBLE = 1e-8
"""Neurons with a smaller share than this, of the nearest one's, are left out."""


ABREAST = 64
"""Points that are worked on together."""


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
    skipped, reach = 3 - dimensions, len(fall) - 1
    box = _box(values, grid[0], skipped)
    among = np.empty(ABREAST, dtype=np.int64)
    nearest = np.zeros((3, ABREAST), dtype=np.int64)
    basis = np.zeros((3, 2 * reach + 1, ABREAST))
    basis[:, reach] = 1.0
    n = 0
    while n < count:
        found = 0
        while n < count and found < ABREAST:
            among[found] = n
            inside = True
            for axis in range(skipped, 3):
                index = _nearest(points[n, axis - skipped], grid)
                nearest[axis, found] = index
                inside &= index + reach >= box[axis, 0] and index - reach < box[axis, 1]
            # Of what is blocked most is far away.
            found += inside
            n += 1
        whole = np.ones(ABREAST)
        for axis in range(skipped, 3):
            x = points[among[:found], axis - skipped]
            whole *= _bases(x, nearest[axis], fall, grid, basis[axis])
        for m in range(found):
            means[among[m]] = _mean(values, basis, nearest, box, m, grid[0]) / whole[m]
    return means


@numba.njit(cache=True, error_model='numpy')
def _box(values, side, skipped):
    """Return (3, 2) first index and that after the last where values are not 0, by axis."""
    box = np.zeros((3, 2), dtype=np.int64)
    box[:skipped, 1], box[skipped:, 0] = 1, side
    for k in range(len(values)):
        if values[k] != 0.0:
            left = k
            for axis in range(2, skipped - 1, -1):
                index = left % side
                box[axis, 0] = min(box[axis, 0], index)
                box[axis, 1] = max(box[axis, 1], index + 1)
                left //= side
    return box


@numba.njit(cache=True, error_model='numpy')
def _nearest(x, grid):
    return min(max(int(np.rint((x + 1.0) / grid[1])), 0), grid[0] - 1)


@numba.njit(cache=True, error_model='numpy')
def _bases(x, nearest, fall, grid, basis):
    """Write the basis of the neurons around each point along one axis; return their sums.

    exp(-(a - j h)^2 / 2 s^2), relative to j = 0, is exp(a h / s^2)^j exp(-(j h)^2 / 2 s^2): one
    exponential for all neurons. Loops over points are innermost, so that they run abreast.
    """
    side, spacing, steepness = grid
    total, ratio, power = np.ones(ABREAST), np.empty(len(x)), np.empty(len(x))
    for m in range(np.uint64(len(x))):
        exponent = (x[m] - (nearest[m] * spacing - 1.0)) * steepness
        ratio[m] = exp(min(max(exponent, LOWEST), HIGHEST))
    reach = len(fall) - 1
    for direction in (1, -1):
        power[:] = 1.0
        for j in range(1, reach + 1):
            row = basis[reach + direction * j]
            for m in range(np.uint64(len(x))):
                power[m] *= ratio[m]
                index = nearest[m] + direction * j
                # Beyond the edge powers may overflow.
                row[m] = power[m] * fall[j] if 0 <= index < side else 0.0
                total[m] += row[m]
        for m in range(np.uint64(len(x))):
            ratio[m] = 1.0 / ratio[m]
    return total


@numba.njit(cache=True, error_model='numpy')
def _mean(values, basis, nearest, box, m, side):
    reach = basis.shape[1] // 2
    total = 0.0
    i_first, j_first, k_first = (
        nearest[0, m] - reach, nearest[1, m] - reach, nearest[2, m] - reach
    )
    for i in range(max(i_first, box[0, 0]), min(i_first + 2 * reach + 1, box[0, 1])):
        plane = 0.0
        for j in range(max(j_first, box[1, 0]), min(j_first + 2 * reach + 1, box[1, 1])):
            line, begin = 0.0, (i * side + j) * side
            for k in range(max(k_first, box[2, 0]), min(k_first + 2 * reach + 1, box[2, 1])):
                line += basis[2, k - k_first, m] * values[begin + k]
            plane += basis[1, j - j_first, m] * line
        total += basis[0, i - i_first, m] * plane
    return total
