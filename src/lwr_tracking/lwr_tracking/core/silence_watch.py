# SPDX-License-Identifier: Apache-2.0
"""Notices that the arm reports no more."""

from srnn_msgs_py.joints import JointSample

SILENCE = 1.0
"""Without joint states for this long the tracker stops until reset [s], whoever has slept.

Until then it just waits: without a joint state there is no command, and the arm holds.
"""


class SilenceWatch:
    """Knows the newest joint state and when it came; told the time [s of the steady clock].

    Attributes:
        sample: the newest joint state, None for none since the watch began.
        longest: longest time between two [s].

    """

    def __init__(self) -> None:
        """Begin; nothing is missed before a first joint state."""
        self.sample: JointSample | None = None
        self.longest = 0.0
        self._arrival = 0.0

    def begin(self) -> None:
        """Begin anew."""
        self.sample = None

    def heard(self, sample: JointSample, now: float) -> bool:
        """Take in a joint state; return whether it has come too late.

        A process that has slept may find it before it asks for `seconds_left`.
        """
        silence = 0.0 if self.sample is None else now - self._arrival
        self.longest = max(self.longest, silence)
        self.sample, self._arrival = sample, now
        return silence > SILENCE

    def seconds_left(self, now: float) -> float | None:
        """Return the time until the next joint state is overdue [s], None if none is awaited."""
        return None if self.sample is None else self._arrival + SILENCE - now
