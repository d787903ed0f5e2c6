# SPDX-License-Identifier: Apache-2.0
"""Mean, deviation and percentiles of the last measured durations."""

from collections import deque

import numpy as np


class Durations:
    """The last durations of one kind of work."""

    def __init__(self, kept: int = 10_000) -> None:
        """Keep at most `kept` of them."""
        self._seconds: deque[float] = deque(maxlen=kept)

    def record(self, seconds: float) -> None:
        """Take in one duration [s]."""
        self._seconds.append(seconds)

    @property
    def last(self) -> float:
        """The latest duration [s], 0 before the first."""
        return self._seconds[-1] if self._seconds else 0.0

    def summary_ms(self) -> dict[str, float]:
        """Return mean, sd, p50 and p99 [ms]; zeros before the first duration."""
        values = 1e3 * np.array(self._seconds if self._seconds else [0.0])
        p50, p99 = np.percentile(values, [50.0, 99.0])
        return {
            'mean': float(values.mean()),
            'sd': float(values.std()),
            'p50': float(p50),
            'p99': float(p99),
        }
