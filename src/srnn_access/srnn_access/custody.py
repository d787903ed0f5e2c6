# SPDX-License-Identifier: Apache-2.0
"""Who is in charge of a topic: the rules by which a listener accepts messages."""

from srnn_access.mark import Mark
from srnn_access.refusal import Refusal

WINDOW_S = 5.0
"""A sender never heard before must have signed its message within this time of now [s]."""

LONGEST_MOTION_S = 3.0
"""No message keeps its topic for longer than this beyond the time to hold [s]."""

_ANONYMOUS = 0


class Custody:
    """The state of one topic for one listener; pure, told the time.

    Order: of one sender, only ever later messages are accepted, and nothing of a sender
    that began before the newest accepted one: that one is a recording, or was thought dead.

    Ownership: whoever was heard last is in charge for the time to hold; others wait. A
    sender without a mark is one of the others, and the order cannot be asked of it.

    Freshness: a sender never heard before must have signed just now. The system clock
    matters at no other time.
    """

    def __init__(self, hold: float) -> None:
        """Nobody is in charge.

        Args:
            hold: how long the last sender stays in charge [s].

        """
        self._hold = hold
        self._newest = (_ANONYMOUS, 0)
        self._owner: int | None = None
        self._until = 0.0

    def judge(
        self, mark: Mark | None, now: float, wall_ns: int, motion: float = 0.0
    ) -> Refusal | None:
        """Accept a message whose code, if it needs one, fits; or say what it breaks.

        Args:
            mark: its mark, None for a message without one.
            now: time of arrival [s of a steady clock].
            wall_ns: time of arrival [ns of the system clock].
            motion: how long the motion takes that it asks for [s]; the sender stays in
                charge until it is over, and the time to hold.

        """
        if mark is not None and mark[:2] <= self._newest:
            return Refusal.REPLAYED
        source = _ANONYMOUS if mark is None else mark.source
        if source != self._owner:
            if self._owner is not None and now < self._until:
                return Refusal.NOT_OWNER
            if mark is not None and not _fresh(mark, wall_ns):
                return Refusal.OUTDATED
            self._owner = source
        if mark is not None:
            self._newest = mark[:2]
        self._until = max(self._until, now + self._hold + _bounded(motion))
        return None


def _fresh(mark: Mark, wall_ns: int) -> bool:
    return mark.signed_ns is None or abs(wall_ns - mark.signed_ns) <= 1e9 * WINDOW_S


def _bounded(motion: float) -> float:
    return min(max(motion, 0.0), LONGEST_MOTION_S)
