# SPDX-License-Identifier: Apache-2.0
"""Messages that wait in the middleware until they are fetched: cheaper than one by one."""

from collections.abc import Iterator
from typing import Any, NamedTuple, NoReturn

from rclpy.node import Node

from srnn_msgs_py.qos import Qos
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import Topic


class RawMessage(NamedTuple):
    """A message as it was on the wire, and what the middleware knows of it.

    Attributes:
        data: serialized message.
        received_ns: when it arrived [ns of system time].
        sent_ns: when it was sent [ns of system time].
        sequence: its number among those of its sender.

    """

    data: bytes
    received_ns: int
    sent_ns: int
    sequence: int


class PolledTopic:
    """One topic. Its node must not be served by an executor, which would take the messages.

    Attributes:
        name: full name of the topic.
        kind: its message type.

    """

    def __init__(self, node: Node, row: Topic, qos: Qos) -> None:
        """Listen from now on; `qos` says how many messages may wait."""
        self.name: str = node.resolve_topic_name(row.name)
        self.kind: Any = message_type(row.type_name)
        self._handle = node.create_subscription(
            self.kind, row.name, _never, profile(qos), raw=True
        ).handle

    def fetch(self) -> Iterator[RawMessage]:
        """Take what has arrived, oldest first."""
        with self._handle:
            while (taken := self._handle.take_message(self.kind, True)) is not None:
                data, info = taken
                yield RawMessage(
                    data, info['received_timestamp'], info['source_timestamp'],
                    info['publication_sequence_number'],
                )  # fmt: skip


def _never(data: bytes) -> NoReturn:
    raise AssertionError('messages of a polled topic are fetched')
