# SPDX-License-Identifier: Apache-2.0
"""Solve a symmetric positive definite 3 x 3 system without the overhead of LAPACK."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def solve_spd3(matrix: Array, right: Array) -> Array:
    """Return x (3,) with matrix @ x = right, by Cholesky factorisation.

    Args:
        matrix: (3, 3), symmetric positive definite; only the lower half is read.
        right: (3,).

    """
    (a, _, _), (b, d, _), (c, e, f) = matrix.tolist()
    r0, r1, r2 = right.tolist()
    l00 = a**0.5
    l10, l20 = b / l00, c / l00
    l11 = (d - l10 * l10) ** 0.5
    l21 = (e - l20 * l10) / l11
    l22 = (f - l20 * l20 - l21 * l21) ** 0.5
    y0 = r0 / l00
    y1 = (r1 - l10 * y0) / l11
    y2 = (r2 - l20 * y0 - l21 * y1) / l22
    x2 = y2 / l22
    x1 = (y1 - l21 * x2) / l11
    return np.array(((y0 - l10 * x1 - l20 * x2) / l00, x1, x2))
