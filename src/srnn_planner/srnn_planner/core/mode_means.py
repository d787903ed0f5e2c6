# SPDX-License-Identifier: Apache-2.0
"""The mean movement of every mode, compiled."""

import numba
import numpy as np


@numba.njit(cache=True, error_model='numpy')
def mode_means(paths, modes):
    """Return the mean path of each mode.

    Args:
        paths: (S, T, d) samples.
        modes: (n, count) samples of each mode.

    Returns:
        (n, T, d).

    """
    flat = np.ascontiguousarray(paths).reshape(len(paths), -1)
    means = np.zeros((len(modes), flat.shape[1]))
    for n in range(len(modes)):
        mean = means[n]
        for m in range(modes.shape[1]):
            path = flat[modes[n, m]]
            for i in range(np.uint64(len(mean))):
                mean[i] += path[i]
        for i in range(np.uint64(len(mean))):
            mean[i] /= modes.shape[1]
    return means.reshape(len(modes), *paths.shape[1:])
