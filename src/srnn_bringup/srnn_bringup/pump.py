# SPDX-License-Identifier: Apache-2.0
"""Serves the middleware in short, bounded waits."""

from collections.abc import Callable
import time
from typing import Protocol

LONGEST_WAIT_S = 0.05
"""What else may have happened is looked at this often at least [s]."""


class Spinning(Protocol):
    """What is asked of an executor."""

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Handle one event, or return after the time-out [s]."""


class Pump:
    """Handles events, and after each of them looks whether to go on."""

    def __init__(self, executor: Spinning, guard: Callable[[], None]) -> None:
        """Serve `executor`; `guard` raises when it is time to stop."""
        self._executor = executor
        self._guard = guard

    def turn(self, seconds: float = LONGEST_WAIT_S) -> None:
        """Handle at most one event; wait no longer than this for it [s]."""
        self._executor.spin_once(timeout_sec=min(seconds, LONGEST_WAIT_S))
        self._guard()

    def until(self, condition: Callable[[], object], seconds: float) -> bool:
        """Handle events until a condition holds; False if it does not within the time [s]."""
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                return False
            self.turn()
        return True

    def unguarded(self) -> 'Pump':
        """Return a pump for the same executor that goes on in any case."""
        return Pump(self._executor, lambda: None)
