# SPDX-License-Identifier: Apache-2.0
"""Exponential and logarithm inside kernels: without a call, many are under way at a time."""

from math import factorial

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


_EXPONENTIAL = tuple(1.0 / factorial(n) for n in range(13, -1, -1))
_LOGARITHM = tuple(1.0 / n for n in range(17, 0, -2))


@numba.njit(cache=True, error_model='numpy')
def _series(coefficients, x):
    """Return a polynomial whose highest coefficient comes first."""
    value = 0.0
    for coefficient in coefficients:
        value = value * x + coefficient
    return value


@numba.njit(cache=True, error_model='numpy')
def exp(x):
    """Return e^x to 1e-15, for x from `LOWEST` to `HIGHEST`."""
    # Adding a number whose last bit is 1 rounds to a whole number.
    n = x * _PER_LOG2 + _SHIFTER - _SHIFTER
    r = x - n * _LOG2_HIGH - n * _LOG2_LOW
    series = _series(_EXPONENTIAL, r)
    # A power of two is its exponent, shifted.
    return series * number_of((np.int64(n) + _BIAS) << _MANTISSA)


@numba.njit(cache=True, error_model='numpy')
def log(x):
    """Return the logarithm of a normal number, to 1e-15 of it or absolutely."""
    bits = bits_of(x)
    # Between sqrt(1/2) and sqrt(2) times a power of two.
    exponent = (bits - bits_of(_ROOT_HALF)) >> _MANTISSA
    m = number_of(bits - (exponent << _MANTISSA))
    s = (m - 1.0) / (m + 1.0)
    square = s * s
    series = _series(_LOGARITHM, square)
    return exponent * _LOG2 + 2.0 * s * series
