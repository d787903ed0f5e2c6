# SPDX-License-Identifier: Apache-2.0
"""What a node knows of keys and senders."""

from collections import Counter
from pathlib import Path
import time
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.lifecycle import LifecycleNode
from rclpy.lifecycle.publisher import LifecyclePublisher

from srnn_access import Key, Refusal, Source
from srnn_access.key_file import load
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import Topic
from srnn_node.inlet import Inlet
from srnn_node.marked_publisher import MarkedPublisher
from srnn_node.outlet import Outlet

PARAMETER = 'key_file'
MEANING = 'File with the key that all nodes share; empty for none, and whoever sends is believed.'

RECENT_S = 2.0
"""A refusal is a warning for this long [s]."""


def declare_key_file(node: LifecycleNode) -> None:
    """Declare the parameter; nobody can take the key from a running node."""
    node.declare_parameter(
        PARAMETER, '', ParameterDescriptor(description=MEANING, read_only=True)
    )


class Access:
    """The key of one node, itself as a sender, and what it has refused."""

    def __init__(self, node: LifecycleNode, key: Key | None = None) -> None:
        """Guard the topics of `node`, by marks alone without a key."""
        self._node = node
        self._key = key
        self._source = Source()
        self._inlets: dict[str, Inlet] = {}

    @classmethod
    def configured(cls, node: LifecycleNode) -> 'Access':
        """Return the access of a node with the key that its parameter names.

        Raises:
            AccessError: the key file is missing, or not as it must be.

        """
        path = node.get_parameter(PARAMETER).value
        return cls(node, load(Path(path)) if path else None)

    def publisher(self, row: Topic) -> LifecyclePublisher:
        """Return a publisher for a topic of the table."""
        kind, qos = message_type(row.type_name), profile(row.qos)
        if row.ownership is None or not (self._key or row.ownership.always):
            return self._node.create_lifecycle_publisher(kind, row.name, qos)
        keep = row.qos.latched
        events = PublisherEventCallbacks(matched=lambda change: publisher.renew(change))
        publisher: Any = self._node.create_publisher(
            kind, row.name, qos, publisher_class=MarkedPublisher,
            event_callbacks=events if keep else None,
        )
        publisher.use(Outlet(row, publisher.topic_name, self._source, self._key), keep)
        self._node.add_managed_entity(publisher)
        return publisher

    def inlet(self, row: Topic) -> Inlet:
        """Return the judge for a topic of the table."""
        inlet = Inlet(row, self._node.resolve_topic_name(row.name), self._key)
        self._inlets[row.name] = inlet
        return inlet

    def extend(self, health: Health) -> Health:
        """Add what was refused: a count for every reason, and a warning while it goes on."""
        counts: Counter[Refusal] = Counter()
        for inlet in self._inlets.values():
            counts.update(inlet.refused)
        values: dict[str, float | int | str] = {'key': self._key.fingerprint} if self._key else {}
        values.update({f'access_{reason.name.lower()}': n for reason, n in counts.items()})
        words = '; '.join(filter(None, [health.message, *self._complaints()]))
        warned = words != health.message
        level = max(health.level, HealthLevel.WARN) if warned else health.level
        return Health(level, words, {**health.values, **values})

    def _complaints(self) -> list[str]:
        now = time.monotonic()
        return [
            f'refused: {name} {inlet.last.value}'
            for name, inlet in self._inlets.items()
            if inlet.last is not None and now - inlet.last_time <= RECENT_S
        ]
