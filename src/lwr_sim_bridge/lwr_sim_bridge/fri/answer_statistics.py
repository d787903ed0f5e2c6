# SPDX-License-Identifier: Apache-2.0
"""What the controller thinks of the answers that it gets."""

from collections import deque

import numpy as np

from lwr_sim_bridge.fri.parameters import PatienceParameters

UNACCEPTABLE, BAD, OK, PERFECT = range(4)

WINDOW = 100
"""Packets over which rates, latency and jitter are taken."""


class AnswerStatistics:
    """Counts answers and misses; the quality is a leaky account of them.

    Attributes:
        misses: cycles without an answer, ever.
        in_a_row: cycles without an answer since the last one.

    """

    def __init__(self, parameters: PatienceParameters) -> None:
        """Begin with an empty account."""
        self._parameters = parameters
        self._answered: deque[bool] = deque(maxlen=WINDOW)
        self._latencies: deque[float] = deque(maxlen=WINDOW)
        self._account = 0
        self.misses = 0
        self.in_a_row = 0

    def answer(self, latency: float) -> None:
        """Take in that a cycle was answered `latency` [s] after its packet went out."""
        self._answered.append(True)
        self._latencies.append(latency)
        self._account = min(self._account + 1, self._parameters.cap)
        self.in_a_row = 0

    def miss(self) -> None:
        """Take in that a cycle was not answered in time."""
        self._answered.append(False)
        self._account = max(self._account - 1, 0)
        self.misses += 1
        self.in_a_row += 1

    @property
    def quality(self) -> int:
        """Return the level of the account."""
        if self._account >= self._parameters.perfect:
            return PERFECT
        if self._account >= self._parameters.ok:
            return OK
        return BAD if self._account else UNACCEPTABLE

    @property
    def answer_rate(self) -> float:
        """Share of the last cycles that were answered."""
        return sum(self._answered) / len(self._answered) if self._answered else 0.0

    @property
    def latency(self) -> float:
        """Mean time to the answer [s]."""
        return float(np.mean(self._latencies)) if self._latencies else 0.0

    @property
    def jitter(self) -> float:
        """Standard deviation of the time to the answer [s]."""
        return float(np.std(self._latencies)) if self._latencies else 0.0
