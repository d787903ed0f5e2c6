# SPDX-License-Identifier: Apache-2.0
"""How far movements jump, compiled."""

import numba
import numpy as np


@numba.njit(cache=True, error_model='numpy')
def longest_steps(paths):
    """Return how far each of the paths (S, T, d) goes at most from one step to the next (S,)."""
    samples, steps, dimensions = paths.shape
    longest = np.zeros(samples)
    for s in range(samples):
        for t in range(1, steps):
            square = 0.0
            for d in range(dimensions):
                square += (paths[s, t, d] - paths[s, t - 1, d]) ** 2
            longest[s] = max(longest[s], square)
    return np.sqrt(longest)
