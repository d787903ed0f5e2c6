# SPDX-License-Identifier: Apache-2.0
"""Solve a symmetric positive definite 3 x 3 system without the overhead of LAPACK."""

import numba
import numpy as np


@numba.njit(cache=True)
def solve_spd3(matrix, right):
    """Return x (3,) with matrix @ x = right, by Cholesky factorisation.

    Args:
        matrix: (3, 3), symmetric positive definite; only the lower half is read.
        right: (3,).

    """
    l00 = np.sqrt(matrix[0, 0])
    l10, l20 = matrix[1, 0] / l00, matrix[2, 0] / l00
    l11 = np.sqrt(matrix[1, 1] - l10 * l10)
    l21 = (matrix[2, 1] - l20 * l10) / l11
    l22 = np.sqrt(matrix[2, 2] - l20 * l20 - l21 * l21)
    y0 = right[0] / l00
    y1 = (right[1] - l10 * y0) / l11
    y2 = (right[2] - l20 * y0 - l21 * y1) / l22
    x2 = y2 / l22
    x1 = (y1 - l21 * x2) / l11
    solution = np.empty(3)
    solution[0], solution[1], solution[2] = (y0 - l10 * x1 - l20 * x2) / l00, x1, x2
    return solution
