# SPDX-License-Identifier: Apache-2.0
"""An absolute schedule of ticks that does not drift."""


class RateKeeper:
    """Tells when ticks are due, on the grid ``start + n * period``.

    Time is an argument: any monotonic clock in seconds will do. A tick that comes
    late does not move those after it. After a long gap at most `catch_up` missed ticks
    are made up for at once; the others are skipped, and the grid stays where it was.

    Attributes:
        period: time between two ticks [s].
        taken: ticks taken.
        overruns: ticks taken more than one period after they were due.
        skipped: ticks that were given up.

    """

    def __init__(self, period: float, start: float, catch_up: int = 3) -> None:
        """Start a schedule whose first tick is due at `start`.

        Args:
            period: time between two ticks [s], > 0.
            start: reading of the clock at which the first tick is due [s].
            catch_up: ticks that may be late at the same time, >= 1.

        Raises:
            ValueError: the period or the number is impossible.

        """
        if not period > 0.0:
            raise ValueError(f'period = {period!r} s: must be > 0')
        if catch_up < 1:
            raise ValueError(f'catch_up = {catch_up!r}: must be >= 1')
        self.period = period
        self.taken = 0
        self.overruns = 0
        self.skipped = 0
        self._start = start
        self._catch_up = catch_up
        self._next = 0

    @property
    def due(self) -> float:
        """Reading of the clock at which the next tick is due [s]."""
        return self._start + self._next * self.period

    def seconds_to_tick(self, now: float) -> float:
        """Return how long to wait for the next tick [s]; 0 when it is due."""
        return max(0.0, self.due - now)

    def take(self, now: float) -> bool:
        """Take the next tick when it is due, and say whether it was."""
        late = now - self.due
        if late < 0.0:
            return False
        if late > self.period:
            self.overruns += 1
        excess = self._latest_due(now) - self._next + 1 - self._catch_up
        if excess > 0:
            self.skipped += excess
            self._next += excess
        self.taken += 1
        self._next += 1
        return True

    def _latest_due(self, now: float) -> int:
        """Return the number of the last tick that is due, exact in spite of rounding."""
        latest = int((now - self._start) / self.period)
        while self._start + (latest + 1) * self.period <= now:
            latest += 1
        while self._start + latest * self.period > now:
            latest -= 1
        return latest
