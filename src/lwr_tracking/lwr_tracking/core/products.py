# SPDX-License-Identifier: Apache-2.0
"""Products with a Jacobian for compiled code; numba's own ones need SciPy."""

import numba
import numpy as np


@numba.njit(cache=True)
def times(jacobian, vector):
    """Return J v (m,) of a Jacobian (m, n) and a vector (n,)."""
    rows, columns = jacobian.shape
    product = np.zeros(rows)
    for i in range(rows):
        for k in range(columns):
            product[i] += jacobian[i, k] * vector[k]
    return product


@numba.njit(cache=True)
def gram(jacobian):
    """Return J J^T (m, m) of a Jacobian (m, n)."""
    rows, columns = jacobian.shape
    product = np.zeros((rows, rows))
    for i in range(rows):
        for j in range(rows):
            for k in range(columns):
                product[i, j] += jacobian[i, k] * jacobian[j, k]
    return product
