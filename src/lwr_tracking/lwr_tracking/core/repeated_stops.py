# SPDX-License-Identifier: Apache-2.0
"""Whether segments end in contact at one and the same place, again and again."""

from collections import deque
from math import dist

import numpy as np
from numpy.typing import NDArray

from lwr_tracking.core.parameters import ContactParameters

Array = NDArray[np.float64]


class RepeatedStops:
    """Counts stops of late, without the tip having got away in between.

    Learning needs a few touches, and ways back may be blocked; whoever sends segment after
    segment against the same place presses on it all the time.
    """

    def __init__(self, parameters: ContactParameters) -> None:
        """Have seen no stop."""
        self._parameters = parameters
        self._times: deque[float] = deque(maxlen=parameters.repeats + 1)
        self._place: list[float] | None = None

    def moved(self, tip: Array) -> None:
        """Take in where the tip is (3,) [m]: away from a stop, that one is forgotten."""
        if self._place is not None and dist(tip.tolist(), self._place) > self._parameters.place:
            self.forget()

    def forget(self) -> None:
        """Begin anew."""
        self._times.clear()
        self._place = None

    def stop(self, now: float, tip: Array) -> bool:
        """Take in a stop at a time [s] and place (3,) [m]; return whether it is one too many."""
        if self._place is None:
            self._place = tip.tolist()
        self._times.append(now)
        too_many = len(self._times) > self._parameters.repeats
        return too_many and now - self._times[0] <= self._parameters.window
