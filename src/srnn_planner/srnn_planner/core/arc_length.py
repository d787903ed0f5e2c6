# SPDX-License-Identifier: Apache-2.0
"""Points at even distances along a polynomial, compiled."""

import numba
import numpy as np

_FINER = 4
"""The length is that of a line through so many times more points."""


@numba.njit(cache=True, error_model='numpy')
def evenly(coefficients, count):
    """Return points at even distances along a polynomial, and its length.

    Args:
        coefficients: (n, d), row m belongs to s^m, s from 0 to 1.
        count: number of points, the first at s = 0 and the last at s = 1.

    Returns:
        points: (count, d).
        length: in the unit of the points.

    """
    fine, dimensions = _FINER * count, coefficients.shape[1]
    line, distance = np.zeros((fine, dimensions)), np.zeros(fine)
    for i in range(fine):
        square = 0.0
        for d in range(dimensions):
            for m in range(len(coefficients) - 1, -1, -1):
                line[i, d] = line[i, d] * (i / (fine - 1)) + coefficients[m, d]
            if i > 0:
                square += (line[i, d] - line[i - 1, d]) ** 2
        if i > 0:
            distance[i] = distance[i - 1] + np.sqrt(square)
    points, length, i = np.empty((count, dimensions)), distance[-1], 0
    for n in range(count):
        along = length * n / (count - 1)
        while i < fine - 2 and distance[i + 1] < along:
            i += 1
        step = distance[i + 1] - distance[i]
        share = min((along - distance[i]) / step, 1.0) if step > 0.0 else 0.0
        for d in range(dimensions):
            points[n, d] = line[i, d] + share * (line[i + 1, d] - line[i, d])
    return points, length
