# SPDX-License-Identifier: Apache-2.0
"""Which movements lead into similar directions, compiled."""

import numba
import numpy as np


@numba.njit(cache=True, error_model='numpy')
def nearest_directions(displacement, count):
    """Return the `count` samples whose directions are nearest to that of each one.

    Args:
        displacement: (S, d) last minus first point of each sample.
        count: how many, at most S.

    Returns:
        (S, count) samples, the nearest first, itself in front; of two as near the first.

    """
    samples, dimensions = displacement.shape
    unit = np.empty((samples, dimensions))
    for s in range(samples):
        square = 0.0
        for d in range(dimensions):
            square += displacement[s, d] ** 2
        for d in range(dimensions):
            unit[s, d] = displacement[s, d] / max(np.sqrt(square), 1e-12)
    nearest = np.empty((samples, count), dtype=np.int64)
    cosines = np.empty(count)
    for s in range(samples):
        nearest[s, 0], cosines[0] = s, np.inf
        found = 1
        for other in range(samples):
            if other == s:
                continue
            cosine = 0.0
            for d in range(dimensions):
                cosine += unit[s, d] * unit[other, d]
            if found < count:
                found += 1
            elif cosine <= cosines[count - 1]:
                continue
            place = found - 1
            while cosines[place - 1] < cosine:
                cosines[place] = cosines[place - 1]
                nearest[s, place] = nearest[s, place - 1]
                place -= 1
            cosines[place], nearest[s, place] = cosine, other
    return nearest
