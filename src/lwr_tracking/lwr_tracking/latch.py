# SPDX-License-Identifier: Apache-2.0
"""What has stopped the arm until reset: told once, and kept for a successor."""

from collections.abc import Callable
from pathlib import Path

from lwr_tracking.core.failsafe import Condition, decide
from lwr_tracking.latch_file import LatchFile


class Latch:
    """Follows the conditions of a tracker.

    Attributes:
        conditions: those that last until reset.

    """

    def __init__(self, path: str, complain: Callable[[str], None]) -> None:
        """Begin with what a predecessor has left.

        Args:
            path: file that keeps it, empty for none.
            complain: tells a person.

        """
        self._file = LatchFile(Path(path) if path else None)
        self.conditions = self._file.read()
        self._complain = complain

    def follow(self, conditions: Condition) -> None:
        """Take in all conditions of now."""
        latched = decide(conditions).latched
        if latched == self.conditions:
            return
        if latched & ~self.conditions:
            self._complain(f'frozen until reset: {", ".join(decide(latched).causes)}')
        self._keep(latched)

    def add(self, condition: Condition) -> None:
        """Take in one that was asked for, which is no news."""
        self._keep(self.conditions | condition)

    def _keep(self, latched: Condition) -> None:
        self.conditions = latched
        try:
            self._file.write(latched)
        except OSError as error:
            self._complain(f'latch: {error}')
