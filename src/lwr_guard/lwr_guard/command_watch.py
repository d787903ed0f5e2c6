# SPDX-License-Identifier: Apache-2.0
"""Whether commands still come, and how many are missing."""

from lwr_guard.parameters import GuardParameters

WINDOW = 100
"""Cycles over which the share of answered ones is taken."""

SPARSE = 0.95
"""With a smaller share answered, somebody should look at the machine or the network."""

POOR = 0.90
"""With a smaller share answered, the link is not fit for use."""


class CommandWatch:
    """Notices that good commands have ceased, by the time of the last one.

    The arm is told joint angles: without a new command it comes to rest at the last one,
    carried by its own gravity compensation. A stream may begin again at any time; the
    gate lets it do so only from near there.

    Attributes:
        holding: good commands came, and have ceased.
        holds: how often they have.

    """

    def __init__(self, parameters: GuardParameters) -> None:
        """Wait for the first command."""
        self.holding = False
        self.holds = 0
        self._silence = parameters.silence
        self._last: float | None = None
        self._answered = 0
        self._cycles = 0

    def good(self, now: float) -> None:
        """Take in that a command was accepted at `now` [s]."""
        self._last = now
        self._answered |= 1

    def cycle(self, now: float) -> bool:
        """End a cycle of the arm at `now` [s]; return whether it has to hold its pose."""
        if self._last is None:
            return False
        # Times are sums of ticks, and not exact.
        ceased = now - self._last > self._silence - 1e-9
        self.holds += ceased and not self.holding
        self.holding = ceased
        self._answered = (self._answered << 1) & ((1 << WINDOW + 1) - 1)
        self._cycles = min(self._cycles + 1, WINDOW)
        return ceased

    def silent_for(self, now: float) -> float:
        """Return the time from the last good command until `now` [s]; 0 before the first."""
        return 0.0 if self._last is None else now - self._last

    @property
    def answered(self) -> float:
        """Share of the last `WINDOW` cycles that brought a good command; 1 before the first."""
        return (self._answered >> 1).bit_count() / self._cycles if self._cycles else 1.0
