# SPDX-License-Identifier: Apache-2.0
"""What has stopped the arm until reset, on disk: it outlives the process that found it."""

from dataclasses import dataclass
import os
from pathlib import Path

from lwr_tracking.core.failsafe import Condition, decide

LARGEST = 4096
"""No file with the names of all conditions is larger [bytes]."""


@dataclass(frozen=True)
class LatchFile:
    """The latched conditions of a tracker, by name.

    Attributes:
        path: the file; there is none while nothing is latched. None keeps nothing.

    """

    path: Path | None

    def write(self, conditions: Condition) -> None:
        """Keep the latched ones of these conditions, all or nothing.

        Raises:
            OSError: the file cannot be written.

        """
        if self.path is None:
            return
        latched = decide(conditions).latched
        if not latched:
            self.path.unlink(missing_ok=True)
            return
        # Not flushed to the disk: it has to outlive the process, not the machine.
        beside = self.path.with_name(f'{self.path.name}.new')
        beside.write_text('\n'.join(str(c.name) for c in latched), encoding='utf-8')
        os.replace(beside, self.path)

    def read(self) -> Condition:
        """Return what was latched; a file that cannot be read counts as a stop."""
        if self.path is None or not self.path.exists():
            return Condition.NONE
        try:
            with self.path.open('rb') as file:
                names = file.read(LARGEST).decode().split()
            latched = Condition.NONE
            for name in names:
                latched |= Condition[name]
        except (OSError, UnicodeDecodeError, KeyError):
            return Condition.STOPPED
        return decide(latched).latched or Condition.STOPPED
