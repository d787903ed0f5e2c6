# SPDX-License-Identifier: Apache-2.0
"""Whether segments end in contact at one and the same place, again and again."""

from collections import deque
from collections.abc import Sequence
from math import dist

from lwr_tracking.core.parameters import ContactParameters


class RepeatedStops:
    """Counts stops of late, without the tip having got away in between.

    Learning needs a few touches, and ways back may be blocked; whoever sends segment after
    segment against the same place presses on it all the time.
    """

    def __init__(self, parameters: ContactParameters) -> None:
        """Have seen no stop."""
        self._parameters = parameters
        self._times: deque[float] = deque(maxlen=parameters.repeats + 1)
        self._place: tuple[float, ...] | None = None

    def moved(self, tip: Sequence[float]) -> None:
        """Take in where the tip is (x, y, z) [m]: away from a stop, that one is forgotten."""
        if self._place is not None and dist(tip, self._place) > self._parameters.place:
            self.forget()

    def forget(self) -> None:
        """Begin anew."""
        self._times.clear()
        self._place = None

    def stop(self, now: float, tip: Sequence[float]) -> bool:
        """Take in a stop at a time [s] and place [m]; return whether it is one too many."""
        if self._place is None:
            self._place = tuple(tip)
        self._times.append(now)
        too_many = len(self._times) > self._parameters.repeats
        return too_many and now - self._times[0] <= self._parameters.window
