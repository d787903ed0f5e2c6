# SPDX-License-Identifier: Apache-2.0
"""The pull of a way point, compiled: it is computed anew for every segment."""

import numba
import numpy as np

from srnn_planner.core.elementary import HIGHEST, LOWEST, exp, log

_SMALLEST = 1e-300


@numba.njit(cache=True, error_model='numpy')
def generalized_error(centres, neurons, detour, scale, exponent):
    """Return exp(-((|c_j - p_k| + detour_k) / scale)^exponent) as (N, K), 1 at distance 0.

    Args:
        centres: (N, d) centres c.
        neurons: (K, d) positions p.
        detour: (K,) what the way from each neuron is longer than the beeline.
        scale: unit of distances.
        exponent: 1 for a Laplace, 2 for a Gaussian distribution.

    """
    count, dimensions = neurons.shape
    share = np.zeros((len(centres), count))
    for j in range(len(centres)):
        # Loops without a loop inside, over numbers that lie side by side, run eight abreast.
        row = share[j]
        for d in range(dimensions):
            for k in range(np.uint64(count)):
                row[k] += (centres[j, d] - neurons[k, d]) ** 2
        for k in range(np.uint64(count)):
            distance = max((np.sqrt(row[k]) + detour[k]) / scale, _SMALLEST)
            power = exp(min(max(exponent * log(distance), LOWEST), HIGHEST))
            row[k] = exp(max(-power, LOWEST))
    return share
