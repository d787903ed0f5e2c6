# SPDX-License-Identifier: Apache-2.0
"""Whether measurements are answered in time."""

LATE = 1.5
"""A tick is late when this many periods have passed since the last one."""

TOLERATED = 4
"""Late ticks in a row that are no overload."""

RECOVERED = 50
"""Ticks after which an overload is over if it has not begun anew; some of them may be late."""

MANY = 10
"""With more late ticks than this among the last 50 the arm is to go slower."""

SLOW = 0.7
"""Share of its speed that the arm has then: ticks that come in bunches make it hurry between.

It has no more after a tick so late that it was held meanwhile: it swings as it sets off."""

GLIDE = 0.004
"""Largest change of that share from one tick to the next."""

HELD_AFTER = 0.02
"""The arm side holds its pose after so long without a command [s] (`lwr_guard`)."""

AT_REST_AFTER = 0.1
"""The arm side has come to rest after so long without a command [s] (`lwr_guard`)."""

_ALL = (1 << RECOVERED) - 1


class TickWatch:
    """Tells an overloaded machine from one late tick.

    Late ticks here and there do no harm. On a busy machine they never end, so that an arm
    which waited for their end would rest for ever. Where there are many it goes slower.

    Attributes:
        late: late ticks so far.
        pace: share of its speed that the arm should have, `SLOW` to 1.

    """

    def __init__(self, period: float) -> None:
        """Take the nominal time between two ticks [s]."""
        self.late = 0
        self.pace = 1.0
        self._longest = LATE * period
        self._run = 0
        """Late ticks in a row."""
        self._left = 0
        """Ticks until the overload is over."""
        self._recent = 0
        """One bit for each of the last ticks, set if it was late."""

    def tick(self, elapsed: float) -> bool:
        """Take in a tick `elapsed` [s] after the last; return whether there is an overload."""
        late = elapsed > self._longest
        self.late += late
        self._recent = (self._recent << 1 | late) & _ALL
        pace = self.pace + (-GLIDE if self._recent.bit_count() > MANY else GLIDE)
        if elapsed > HELD_AFTER or pace < SLOW:
            pace = SLOW
        self.pace = pace if pace < 1.0 else 1.0
        self._run = self._run + 1 if late else 0
        if self._run > TOLERATED:
            self._left = RECOVERED
        elif self._left:
            self._left -= 1
        return self._left > 0
