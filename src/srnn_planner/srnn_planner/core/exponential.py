# SPDX-License-Identifier: Apache-2.0
"""The exponential inside kernels, without a call: many of them are under way at a time."""

import numba
import numpy as np

from srnn_planner.core.intrinsics import power_of_two

LOWEST = -700.0
"""The exponential of less is not taken."""

_PER_LOG2 = 1.0 / np.log(2.0)
_LOG2_HIGH, _LOG2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10
"""log(2) in two parts, the first of 32 bits (fdlibm)."""

_SHIFTER = 1.5 * 2.0**52


@numba.njit(cache=True, error_model='numpy')
def exp(x):
    """Return e^x to 1e-15, for x from `LOWEST` to 0."""
    # Adding a number whose last bit is 1 rounds to a whole number.
    n = x * _PER_LOG2 + _SHIFTER - _SHIFTER
    r = x - n * _LOG2_HIGH - n * _LOG2_LOW
    series = 1.0 / 6227020800.0
    series = series * r + 1.0 / 479001600.0
    series = series * r + 1.0 / 39916800.0
    series = series * r + 1.0 / 3628800.0
    series = series * r + 1.0 / 362880.0
    series = series * r + 1.0 / 40320.0
    series = series * r + 1.0 / 5040.0
    series = series * r + 1.0 / 720.0
    series = series * r + 1.0 / 120.0
    series = series * r + 1.0 / 24.0
    series = series * r + 1.0 / 6.0
    series = series * r + 0.5
    series = series * r + 1.0
    series = series * r + 1.0
    return series * power_of_two(np.int64(n))
