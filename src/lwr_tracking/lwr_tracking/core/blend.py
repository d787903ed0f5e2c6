# SPDX-License-Identifier: Apache-2.0
"""Fade a small offset at the start of a segment out, so that it joins without a jump."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def fade(times: Array, offset: Array, slope: Array, span: float) -> tuple[Array, Array, Array]:
    """Return the quintic that falls from an offset to nothing.

    The curve has value `offset`, slope `slope` and no curvature at time 0; value,
    slope and curvature are 0 from `span` on.

    Args:
        times: (T,) path times [s].
        offset: (2,) reference minus first knot [m].
        slope: (2,) velocity of the reference minus that of the first knot [m/s].
        span: time after which nothing is left [s].

    Returns:
        Offsets of position [m], velocity [m/s] and acceleration [m/s^2], (T, 2) each.

    """
    u = np.minimum(times / span, 1.0)[:, None]
    rest = 1.0 - u
    h0 = rest**3 * (1.0 + 3.0 * u + 6.0 * u**2)
    h1 = rest**3 * (u + 3.0 * u**2)
    d0 = -30.0 * u**2 * rest**2
    d1 = rest**2 * (1.0 + 2.0 * u - 15.0 * u**2)
    e0 = -60.0 * u * rest * (rest - u)
    e1 = -12.0 * u * rest * (3.0 - 5.0 * u)
    return (
        h0 * offset + h1 * span * slope,
        d0 * offset / span + d1 * slope,
        e0 * offset / span**2 + e1 * slope / span,
    )
