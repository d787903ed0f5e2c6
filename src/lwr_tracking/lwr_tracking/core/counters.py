# SPDX-License-Identifier: Apache-2.0
"""What happened since the start, in numbers."""

from dataclasses import dataclass, field

from lwr_tracking.core.refusal import Refusal


@dataclass
class Counters:
    """Counts for the diagnostics.

    Attributes:
        accepted: segments that passed the gate.
        refused: segments that did not, and accepted ones dropped later, by reason.
        contacts: segments that ended BLOCKED.
        yields: times the arm gave way because it was pushed while holding still.
        faults: reactions that latched.
        soft_stops: segments that nothing continued in time.
        late_ticks: measurements that were answered late.

    """

    accepted: int = 0
    refused: dict[Refusal, int] = field(default_factory=dict)
    contacts: int = 0
    yields: int = 0
    faults: int = 0
    soft_stops: int = 0
    late_ticks: int = 0

    def refuse(self, reason: Refusal) -> None:
        """Count one segment that was not executed."""
        self.refused[reason] = self.refused.get(reason, 0) + 1

    @property
    def late(self) -> int:
        """Segments that came after their predecessor had begun to brake."""
        return self.refused.get(Refusal.LATE, 0)
