# SPDX-License-Identifier: Apache-2.0
"""What a planner doubts of the world around it: whether it sees the arm, and its own clock."""

import math

from srnn_msgs_py.result import ResultCode

BLIND_S = 1.0
"""Without a pose for this long it is not known where the arm is [s]."""

STALE_IN_A_ROW = 3
"""An interruption of the link makes a segment or two too old, a wrong clock makes all."""


class Doubts:
    """Told what arrives, and when [s of the steady clock]."""

    def __init__(self) -> None:
        """Begin without a pose."""
        self._pose_time = -math.inf
        self._stale_in_a_row = 0

    def posed(self, now: float) -> None:
        """Take in that the arm was seen."""
        self._pose_time = now

    def ended(self, code: ResultCode) -> None:
        """Take in how a segment ended."""
        self._stale_in_a_row = self._stale_in_a_row + 1 if code is ResultCode.STALE else 0

    def blind(self, now: float) -> bool:
        """Tell whether it is not known where the arm is."""
        return now - self._pose_time > BLIND_S

    def words(self, now: float) -> str:
        """Return the gravest doubt, empty for none."""
        if self.blind(now):
            return 'no pose of the arm: nothing is planned'
        if self._stale_in_a_row >= STALE_IN_A_ROW:
            return 'segments are refused as too old: do the clocks of all hosts agree?'
        return ''
