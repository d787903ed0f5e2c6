# SPDX-License-Identifier: Apache-2.0
"""What leaves by a topic: marked with its sender, and sealed if there is a key."""

from typing import Any

from srnn_access import Key, Mark, Seal, Source
from srnn_msgs_py.ros.canonical import canonical
from srnn_msgs_py.ros.mark_carrier import mark_carrier
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.topics import Topic


class Outlet:
    """One topic of one sender; pure, told the time."""

    def __init__(self, row: Topic, name: str, source: Source, key: Key | None) -> None:
        """Number the messages of a topic.

        Args:
            row: its row of the table.
            name: its full name, namespace included.
            source: the sender.
            key: None for marks without a seal.

        """
        self._carrier = mark_carrier(message_type(row.type_name))
        self._seal = Seal(key, name) if key else None
        self._source = source
        self._sequence = 0

    def mark(self, msg: Any, wall_ns: int) -> None:
        """Put the mark of the next message into `msg`, signed at `wall_ns` [ns]."""
        self._sequence += 1
        mark = Mark(self._source.epoch(wall_ns), self._sequence)
        if self._seal is not None:
            mark = mark._replace(signed_ns=wall_ns)
            self._carrier.put(msg, mark.claim())
            mark = mark._replace(code=self._seal.code(canonical(msg)))
            self._carrier.take(msg)
        self._carrier.put(msg, mark.text())

    def unmark(self, msg: Any) -> None:
        """Take the mark out again: the message may be sent once more."""
        self._carrier.take(msg)
