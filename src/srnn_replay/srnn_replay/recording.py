# SPDX-License-Identifier: Apache-2.0
"""What a bag tells of one graph, by topic, and the journals of its nodes."""

from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
import itertools
import json
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from rclpy.serialization import deserialize_message

from srnn_bag import Bag, Message
from srnn_bag.attached import REMAPPED
from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.journal import COLUMNS, Deed, numbers
from srnn_msgs_py.ros import journal
from srnn_msgs_py.ros.mark_carrier import mark_carrier
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.topics import DECIDING, topic
from srnn_replay.errors import FROM_THE_START, NotReplayableError

V = TypeVar('V')


@dataclass(frozen=True, eq=False)
class Session:
    """The journal of one process of a node.

    Attributes:
        began_ns: when it began [ns of system time].
        rows: (n, 5) what it has acted on, see `srnn_msgs_py.journal`.
        until_ns: nothing that was sent later is of this process [ns of system time].

    """

    began_ns: int
    rows: NDArray[np.int64]
    until_ns: int

    @property
    def times(self) -> list[float]:
        """Return when each row was, (n,) as its deed says."""
        return numbers(self.rows[:, COLUMNS.index('time')])

    def has(self, sent_ns: int) -> bool:
        """Tell whether it lived when something was sent [ns of system time]."""
        return self.began_ns <= sent_ns < self.until_ns


class Recording:
    """The messages of one node's topics, read once.

    Attributes:
        node: whose journal is to be followed.
        sessions: the journals of its processes, in order.

    """

    def __init__(self, bag: Bag, node: str, topics: Collection[str], prefix: str) -> None:
        """Read what a node has heard and said.

        Args:
            bag: where from.
            node: name of a node that keeps a journal.
            topics: names in the topic table.
            prefix: namespace of the graph, ending in a slash.

        Raises:
            NotReplayableError: the journal is not whole.

        """
        self.node = node
        self._names = full_names(bag, (*topics, f'{node}/journal'), prefix)
        self._messages: dict[str, list[Message]] = {name: [] for name in self._names.values()}
        kept = self._messages
        for message in bag.messages(kept.keys()):
            kept[message[0]].append(message)
        self.sessions = _sessions(node, self.decoded(f'{node}/journal', journal.from_msg))

    def raw(self, name: str) -> list[Message]:
        """Return the messages of a topic, as they are in the bag."""
        return self._messages[self._names[name]]

    def decoded(self, name: str, convert: Callable[[Any], V]) -> 'list[Decoded[V]]':
        """Return what the messages of a topic say; those that say nothing are left out."""
        return decode(name, self.raw(name), convert)


@dataclass(frozen=True, eq=False)
class Decoded(Generic[V]):
    """A message and what it says."""

    message: Message
    value: V


def unmarked(name: str, message: Message) -> Any:
    """Return a message of a topic of the table without the mark of its sender."""
    row = topic(name)
    kind = message_type(row.type_name)
    msg = deserialize_message(message.data, kind)
    if row.ownership is not None:
        mark_carrier(kind).take(msg)
    return msg


def decode(
    name: str, messages: Iterable[Message], convert: Callable[[Any], V]
) -> 'list[Decoded[V]]':
    """Return what messages of a topic say; those that say nothing are left out."""
    values = []
    for message in messages:
        # What is left out here the nodes have not taken either.
        with suppress(MessageError):
            values.append(Decoded(message, convert(unmarked(name, message))))
    return values


def prefixes(bag: Bag) -> list[str]:
    """Return the namespaces of the graphs in a bag, each ending in a slash.

    Raises:
        NotReplayableError: the bag has no journals.

    """
    return sorted({prefix for prefix, _ in journals(bag)})


def journals(bag: Bag) -> list[tuple[str, str]]:
    """Return the namespace, ending in a slash, and the name of every node with a journal in a bag.

    Raises:
        NotReplayableError: there is none.

    """
    ends = {f'/{node}/journal': node for node in DECIDING}
    places = {
        name: (name[: -len(end) + 1], node)
        for name in bag.topics for end, node in ends.items() if name.endswith(end)
    }  # fmt: skip
    # A recorder listens to the topics of all nodes, whichever there are.
    found = bag.heard(places.keys())
    if not found:
        raise NotReplayableError(f'{bag.path}: has no journals of nodes to replay')
    return sorted(places[name] for name in found)


def full_names(bag: Bag, topics: Iterable[str], prefix: str) -> dict[str, str]:
    """Return the full names of topics in a bag, by their names in the topic table.

    Raises:
        NotReplayableError: what is attached about them is damaged.

    """
    remapped = remapped_topics(bag)
    return {name: remapped.get(prefix + name, prefix + name) for name in topics}


def remapped_topics(bag: Bag) -> Mapping[str, str]:
    """Return the full names of topics in a bag by those that they would have, had nobody remapped.

    Raises:
        NotReplayableError: what is attached about it is damaged.

    """
    try:
        return dict(json.loads(bag.attachments.get(REMAPPED, b'{}')))
    except (TypeError, ValueError):
        raise NotReplayableError(f'{bag.path}: {REMAPPED} in it is damaged') from None


def of_session(messages: list[Message], session: Session) -> list[Message]:
    """Return the messages that were sent in the time of a process."""
    return [message for message in messages if session.has(message.sent_ns)]


def _sessions(node: str, parts: 'list[Decoded[Any]]') -> list[Session]:
    by_session: dict[int, list[Any]] = {}
    for part in parts:
        by_session.setdefault(part.value.session, []).append(part.value)
    starts = sorted(by_session)
    ends = [*starts[1:], 2**63 - 1]
    sessions = []
    for began, until in zip(starts, ends, strict=False):
        pieces = sorted(by_session[began], key=lambda part: part.index)
        expected = itertools.accumulate((len(p.rows) for p in pieces), initial=0)
        for piece, index in zip(pieces, expected, strict=False):
            if piece.index != index:
                raise NotReplayableError(
                    f'{node}: its journal lacks rows {index} to {piece.index - 1}; '
                    f'{FROM_THE_START}'
                )
        if not pieces or pieces[0].rows[0, 0] != Deed.CONFIGURED:
            raise NotReplayableError(f'{node}: its journal does not begin with its process')
        sessions.append(Session(began, np.vstack([p.rows for p in pieces]), until))
    return sessions
