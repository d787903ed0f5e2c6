# SPDX-License-Identifier: Apache-2.0
"""The driver's own opinion of the link, beside that of the controller."""

from collections import deque
from collections.abc import Iterable

import numpy as np

from lwr_fri_driver.core.words import Quality

WINDOW = 100
"""Packets over which losses count, as the controller's own answer rate does."""

RECORD = 2000
"""Answers over which percentiles are taken."""

PERFECT, OK, BAD = 0.99, 0.95, 0.90
"""Least share of cycles with a packet that was answered in time, by quality (our choice)."""


class LinkEstimate:
    """Loss, delay of our answers, and jitter of the controller's packets.

    A cycle is good if its packet came and was answered before the next one was due.
    """

    def __init__(self, cycle: float) -> None:
        """Take the nominal time between two packets [s]."""
        self._cycle = cycle
        self._good: deque[bool] = deque(maxlen=WINDOW)
        self._delays: deque[float] = deque(maxlen=RECORD)
        self._deviations: deque[float] = deque(maxlen=RECORD)
        self._last: float | None = None
        self._open = False

    def heard(self, arrival: float, cycles: int) -> None:
        """Take in that a packet came.

        Args:
            arrival: when it did [s].
            cycles: packets that it is after the last one, 1 if none is missing.

        """
        if self._last is not None:
            self._deviations.append(arrival - self._last - cycles * self._cycle)
            self._good.extend([False] * min(cycles - 1 + self._open, WINDOW))
        self._last, self._open = arrival, True

    def answered(self, delay: float) -> None:
        """Take in that the last packet was answered `delay` [s] after it came."""
        self._delays.append(delay)
        self._good.append(delay < self._cycle)
        self._open = False

    @property
    def share(self) -> float:
        """Share of the last `WINDOW` cycles that were good; 0 before the first."""
        return sum(self._good) / len(self._good) if self._good else 0.0

    @property
    def quality(self) -> Quality:
        """Return what the controller might call it; judged from a full window."""
        if len(self._good) < WINDOW:
            return Quality.UNACCEPTABLE
        share = self.share
        for quality, least in ((Quality.PERFECT, PERFECT), (Quality.OK, OK), (Quality.BAD, BAD)):
            if share >= least:
                return quality
        return Quality.UNACCEPTABLE

    @property
    def jitter(self) -> float:
        """Standard deviation of the time between packets [s]."""
        return float(np.std(self._deviations)) if self._deviations else 0.0

    def delays(self, percentiles: Iterable[float]) -> list[float]:
        """Return percentiles of the time between a packet and its answer [s]."""
        wanted = list(percentiles)
        if not self._delays:
            return [0.0] * len(wanted)
        return [float(value) for value in np.percentile(self._delays, wanted)]
