# SPDX-License-Identifier: Apache-2.0
"""Median and 95th percentile of what was measured."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Quantiles(NamedTuple):
    """Median and 95th percentile, in the unit of the values."""

    p50: float
    p95: float

    def text(self, decimals: int) -> str:
        """Return both with as many decimals."""
        return f'{self.p50:.{decimals}f} / {self.p95:.{decimals}f}'


def quantiles(values: Sequence[float]) -> Quantiles:
    """Return the quantiles of at least one value."""
    return Quantiles(*(float(q) for q in np.percentile(values, (50, 95))))
