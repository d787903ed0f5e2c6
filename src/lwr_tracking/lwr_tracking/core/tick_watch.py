# SPDX-License-Identifier: Apache-2.0
"""Whether measurements are answered in time."""

LATE = 1.5
"""A tick is late when this many periods have passed since the last one."""

TOLERATED = 4
"""Late ticks in a row that are no overload."""

RECOVERED = 50
"""Ticks in time, in a row, that end an overload."""

AT_REST_AFTER = 0.1
"""The arm side has come to rest after so long without a command [s] (`lwr_guard`)."""


class TickWatch:
    """Tells an overloaded machine from one late tick.

    Attributes:
        late: late ticks so far.
        overloaded: ticks have come late again and again, and not yet in time for long.

    """

    def __init__(self, period: float) -> None:
        """Take the nominal time between two ticks [s]."""
        self.late = 0
        self.overloaded = False
        self._longest = LATE * period
        self._run = 0
        """Late ticks in a row if positive, ticks in time if negative."""

    def tick(self, elapsed: float) -> bool:
        """Take in a tick `elapsed` [s] after the last; return whether there is an overload."""
        if elapsed > self._longest:
            self.late += 1
            self._run = max(self._run, 0) + 1
            self.overloaded |= self._run > TOLERATED
        else:
            self._run = min(self._run, 0) - 1
            self.overloaded &= self._run > -RECOVERED
        return self.overloaded
