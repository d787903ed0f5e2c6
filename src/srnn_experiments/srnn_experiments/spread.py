# SPDX-License-Identifier: Apache-2.0
"""Mean, deviation and percentiles as a report holds them."""

from collections.abc import Sequence

import numpy as np


def mean_sd(values: Sequence[float]) -> dict[str, float | None]:
    """Return mean and population standard deviation; None for no values."""
    if not values:
        return {'mean': None, 'sd': None}
    return {'mean': float(np.mean(values)), 'sd': float(np.std(values))}


def spread(values: Sequence[float]) -> dict[str, float | None]:
    """Return mean, deviation, median and 99th percentile; None for no values."""
    if not values:
        return {**mean_sd(values), 'p50': None, 'p99': None}
    p50, p99 = np.percentile(values, [50.0, 99.0])
    return {**mean_sd(values), 'p50': float(p50), 'p99': float(p99)}
