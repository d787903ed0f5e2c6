# SPDX-License-Identifier: Apache-2.0
"""By which power a figure grows."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class PowerLaw:
    """y = factor x^exponent."""

    factor: float
    exponent: float

    def at(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return y for x (n,)."""
        return np.asarray(self.factor * x**self.exponent)


def power_law(x: Sequence[float], y: Sequence[float]) -> PowerLaw:
    """Return the power law of least squares between logarithms.

    Raises:
        ValueError: fewer than two points, or one that is not positive.

    """
    if len(x) < 2 or min(*x, *y) <= 0.0:
        raise ValueError(f'{x}, {y}: must be two positive points at least')
    exponent, level = np.polyfit(np.log(x), np.log(y), 1).tolist()
    return PowerLaw(float(np.exp(level)), exponent)
