# SPDX-License-Identifier: Apache-2.0
"""Exponential and logarithm inside kernels: without a call, many are under way at a time."""

import numba
import numpy as np

from srnn_planner.core.intrinsics import bits_of, number_of

LOWEST, HIGHEST = -700.0, 700.0
"""The exponential of less, and of more, is not taken."""

_PER_LOG2 = 1.0 / np.log(2.0)
_LOG2_HIGH, _LOG2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10
"""log(2) in two parts, the first of 32 bits (fdlibm)."""

_LOG2 = float(np.log(2.0))
_ROOT_HALF = float(np.sqrt(0.5))
_SHIFTER = 1.5 * 2.0**52
_BIAS, _MANTISSA = np.int64(1023), np.int64(52)


@numba.njit(cache=True, error_model='numpy')
def exp(x):
    """Return e^x to 1e-15, for x from `LOWEST` to `HIGHEST`."""
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
    # A power of two is its exponent, shifted.
    return series * number_of((np.int64(n) + _BIAS) << _MANTISSA)


@numba.njit(cache=True, error_model='numpy')
def log(x):
    """Return the logarithm of a normal number, to 1e-13 of it or absolutely."""
    bits = bits_of(x)
    # Between sqrt(1/2) and sqrt(2) times a power of two.
    exponent = (bits - bits_of(_ROOT_HALF)) >> _MANTISSA
    m = number_of(bits - (exponent << _MANTISSA))
    s = (m - 1.0) / (m + 1.0)
    square = s * s
    series = 1.0 / 17.0
    series = series * square + 1.0 / 15.0
    series = series * square + 1.0 / 13.0
    series = series * square + 1.0 / 11.0
    series = series * square + 1.0 / 9.0
    series = series * square + 1.0 / 7.0
    series = series * square + 1.0 / 5.0
    series = series * square + 1.0 / 3.0
    series = series * square + 1.0
    return exponent * _LOG2 + 2.0 * s * series
