# SPDX-License-Identifier: Apache-2.0
"""The way of a command to the arm's own controller, which takes its time."""

from collections import deque
from math import inf

import numpy as np
from numpy.typing import NDArray


class CommandDelay:
    """Hands on joint commands a fixed number of ticks after they were given, in their order."""

    def __init__(self, ticks: int) -> None:
        """Delay by `ticks`; with 0 a command is due at the next call of `due`."""
        self._ticks = ticks
        self._now = 0
        self._waiting: deque[tuple[int, NDArray[np.float64]]] = deque()

    def give(self, q: NDArray[np.float64]) -> None:
        """Send the joint angles `q` (n,) [rad] on their way; they are copied."""
        self._waiting.append((self._now + self._ticks, q.copy()))

    def due(self) -> NDArray[np.float64] | None:
        """Advance by one tick; return the newest command (n,) [rad] that arrives, if any."""
        arrived = None
        while self._waiting and self._waiting[0][0] <= self._now:
            _, arrived = self._waiting.popleft()
        self._now += 1
        return arrived

    @property
    def quiet(self) -> float:
        """Number of ticks from now on in which nothing arrives."""
        return self._waiting[0][0] - self._now if self._waiting else inf

    def skip(self, ticks: int) -> None:
        """Advance by `ticks` in which nothing arrives."""
        self._now += ticks
