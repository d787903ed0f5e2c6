# SPDX-License-Identifier: Apache-2.0
"""How far the tip is from a direction in which no joint can move it."""

import numba
import numpy as np


@numba.njit(cache=True)
def smallest_singular_value(matrix):
    """Return the smallest singular value of a Jacobian J (3, n), by its J J^T (3, 3).

    Closed form of the eigenvalues of a symmetric matrix (Smith 1961); rounding makes it
    uncertain by about 1e-8 of the largest singular value, far below any bound on it.
    """
    a, b, c = matrix[0, 0], matrix[1, 1], matrix[2, 2]
    d, e, f = matrix[1, 0], matrix[2, 1], matrix[2, 0]
    mean = (a + b + c) / 3.0
    a, b, c = a - mean, b - mean, c - mean
    spread = np.sqrt((a * a + b * b + c * c + 2.0 * (d * d + e * e + f * f)) / 6.0)
    if spread == 0.0:
        return np.sqrt(max(mean, 0.0))
    determinant = a * (b * c - e * e) - d * (d * c - e * f) + f * (d * e - b * f)
    cosine = min(max(determinant / (2.0 * spread**3), -1.0), 1.0)
    angle = np.arccos(cosine) / 3.0 + 2.0 * np.pi / 3.0
    return np.sqrt(max(mean + 2.0 * spread * np.cos(angle), 0.0))
