# SPDX-License-Identifier: Apache-2.0
"""Where the controller is told to be, cycle by cycle, and where it goes on without an answer."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class CommandedPath:
    """Joint angles (7,) [rad] that the arm is to have at the end of each cycle.

    Attributes:
        base: where it stood when it was last told to stand.
        target: where it is to be at the end of this cycle.

    """

    def __init__(self, start: ArrayLike) -> None:
        """Stand at `start`."""
        self.base: Array = np.array(start, dtype=float)
        self.target: Array = self.base
        self._before: Array = self.base
        self._obeyed: Array = self.base
        self._stride: Array = np.zeros_like(self.base)
        self._bridged = 0

    def begin_cycle(self) -> None:
        """Stay at the target until told otherwise."""
        self._before = self.target

    def stand(self, position: ArrayLike) -> None:
        """Go to `position` and stay there."""
        self.base = np.array(position, dtype=float)
        self.target = self._obeyed = self.base
        self._stride = np.zeros_like(self.base)
        self._bridged = 0

    def obey(self, position: ArrayLike) -> None:
        """Go to `position`; if cycles were bridged, the way there has taken them as well."""
        self.target = np.array(position, dtype=float)
        self._stride = (self.target - self._obeyed) / (self._bridged + 1)
        self._obeyed, self._bridged = self.target, 0

    def bridge(self) -> None:
        """Go on as in the last cycle that was answered."""
        self._bridged += 1
        self.target = self.target + self._stride

    def points(self, ticks: int) -> Iterator[Array]:
        """Return the way of this cycle in equal steps, finely interpolated."""
        for tick in range(1, ticks + 1):
            share = tick / ticks
            yield (1.0 - share) * self._before + share * self.target

    @property
    def moves(self) -> bool:
        """Tell whether this cycle ends elsewhere than the last one."""
        return not np.array_equal(self._before, self.target)
