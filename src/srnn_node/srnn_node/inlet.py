# SPDX-License-Identifier: Apache-2.0
"""What arrives at a topic: whether it comes from whom it may come."""

from collections import Counter
import math
from typing import Any

from srnn_access import Custody, Key, Mark, Refusal, Seal
from srnn_access.mark import parse
from srnn_msgs_py.ros.canonical import canonical
from srnn_msgs_py.ros.mark_carrier import mark_carrier
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.stamp import SECOND_NS, duration_from_msg
from srnn_msgs_py.topics import Topic


class Inlet:
    """One topic for one listener; pure, told the time.

    Without a key, a topic is open to all unless its messages are always marked.

    Attributes:
        refused: how many messages were refused, by reason.
        last: reason of the last refusal, None before the first.
        last_time: when that was [s of the steady clock].

    """

    def __init__(self, row: Topic, name: str, key: Key | None) -> None:
        """Guard a topic.

        Args:
            row: its row of the table.
            name: its full name, namespace included.
            key: None to believe every mark.

        """
        ownership = row.ownership
        self._open = ownership is None or not (key or ownership.always)
        self.refused: Counter[Refusal] = Counter()
        self.last: Refusal | None = None
        self.last_time = -math.inf
        if ownership is None or self._open:
            return
        self._carrier = mark_carrier(message_type(row.type_name))
        self._seal = Seal(key, name) if key else None
        self._custody = Custody(ownership.hold)
        self._motion = ownership.motion

    def judge(self, msg: Any, now: float, wall_ns: int) -> Refusal | None:
        """Return None for a message to act on, else why not; its mark is taken out.

        Args:
            msg: message of the topic's type.
            now: time of arrival [s of the steady clock].
            wall_ns: time of arrival [ns of the system clock].

        """
        if self._open:
            return None
        refusal = self._judge(msg, now, wall_ns)
        if refusal is not None:
            self.refused[refusal] += 1
            self.last, self.last_time = refusal, now
        return refusal

    def _judge(self, msg: Any, now: float, wall_ns: int) -> Refusal | None:
        text = self._carrier.take(msg)
        mark = None if text is None else parse(text)
        if text is not None and mark is None:
            return Refusal.ALTERED
        if self._seal is not None:
            if mark is None or not mark.code:
                return Refusal.UNSIGNED
            if not self._genuine(self._seal, msg, mark):
                return Refusal.ALTERED
        motion = motion_s(msg) if self._motion else 0.0
        return self._custody.judge(mark, now, wall_ns, motion)

    def _genuine(self, seal: Seal, msg: Any, mark: Mark) -> bool:
        self._carrier.put(msg, mark.claim())
        content = canonical(msg)
        self._carrier.take(msg)
        return seal.fits(mark.code, content)


def motion_s(msg: Any) -> float:
    """Return how long the motion takes that a trajectory message asks for [s]."""
    if not msg.points:
        return 0.0
    return duration_from_msg(msg.points[-1].time_from_start) / SECOND_NS
