# SPDX-License-Identifier: Apache-2.0
"""Whether contacts can be told from rest, before anything moves."""

from collections import deque

SAMPLES = 25
"""The last so many forces are judged: a tenth of a second."""


class LoadCheck:
    """Looks at the force on the tip while the arm stands still at its start.

    A force that would count as contact, or almost, means that something leans on the tip or that
    the arm believes in a wrong load: then no contact could be told from free motion.
    """

    def __init__(self, limit: float) -> None:
        """Take the largest force at rest [N]."""
        self._limit = limit
        self._forces: deque[float] = deque(maxlen=SAMPLES)

    def loaded(self, force: float) -> bool:
        """Take in a force at rest [N]; return whether one of the last is too large."""
        self._forces.append(force)
        return max(self._forces) > self._limit
