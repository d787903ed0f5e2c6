# SPDX-License-Identifier: Apache-2.0
"""Puts the messages of a bag back on the wire, as they were, when they were."""

from collections.abc import Callable, Collection, Iterator
from pathlib import Path
import time
from typing import Any

from builtin_interfaces.msg import Time
from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from srnn_bag import Bag, Message, open_bag
from srnn_bringup.errors import ChoiceError
from srnn_bringup.pump import Pump
from srnn_config.nearest import did_you_mean
from srnn_msgs_py.errors import UnknownTopicError
from srnn_msgs_py.qos import EVENT, Qos
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.ros.stamp import SECOND_NS
from srnn_msgs_py.topics import topic

CLOCK = '/clock'
CLOCK_S = 0.005
"""Recorded time goes out this often [s]."""

LISTENERS_S = 10.0
"""Longest wait for somebody to listen [s]."""


class Republisher:
    """Publishes messages in the rhythm in which they were recorded.

    With a clock, nodes with `use_sim_time` live in recorded time: nothing is too old for them.
    """

    def __init__(self, node: Node, bag: Bag, topics: Collection[str], rate: float) -> None:
        """Offer the topics.

        Args:
            node: who publishes.
            bag: where the messages come from.
            topics: names as in the bag, with or without the slash before them; all if empty.
            rate: how much faster than recorded.

        Raises:
            ChoiceError: the bag does not have one of the topics; the message lists them.

        """
        names = [_find(name, bag) for name in topics] or [*bag.topics]
        self._publishers: dict[str, Any] = {
            name: node.create_publisher(
                message_type(bag.topics[name]), name, profile(_qos(name))
            )
            for name in names
        }
        self._clock = node.create_publisher(Clock, CLOCK, profile(EVENT))
        self._messages = self._sorted(bag)
        self._rate = rate
        self.published = 0

    def heard(self) -> bool:
        """Tell whether every topic has a listener."""
        return all(p.get_subscription_count() for p in self._publishers.values())

    @property
    def count(self) -> int:
        """Number of messages to publish."""
        return len(self._messages)

    def run(self, pump: Pump, tick: Callable[[], object] = lambda: None) -> float:
        """Publish everything; return how long it took [s].

        Args:
            pump: handles events meanwhile.
            tick: called after every message.

        """
        began = time.monotonic()
        if not self._messages:
            return 0.0
        first_ns = told_ns = self._messages[0].received_ns
        for message in self._messages:
            due = began + 1e-9 * (message.received_ns - first_ns) / self._rate
            while (now := time.monotonic()) < due:
                told_ns = self._tell(first_ns + int(1e9 * (now - began) * self._rate), told_ns)
                pump.turn(min(due - now, CLOCK_S))
            told_ns = self._tell(message.received_ns, told_ns)
            self._publishers[message.topic].publish(message.data)
            self.published += 1
            tick()
        return time.monotonic() - began

    def _tell(self, now_ns: int, told_ns: int) -> int:
        """Publish the recorded time if it is due; return the time that was last told."""
        if now_ns - told_ns < CLOCK_S * self._rate * SECOND_NS:
            return told_ns
        stamp = Time(sec=now_ns // SECOND_NS, nanosec=now_ns % SECOND_NS)
        self._clock.publish(Clock(clock=stamp))
        return now_ns

    def _sorted(self, bag: Bag) -> list[Message]:
        return sorted(bag.messages(self._publishers.keys()), key=lambda m: m.received_ns)


def republisher(node: Node, path: Path, topics: Collection[str], rate: float) -> Republisher:
    """Return what publishes a bag; see `Republisher` for the arguments and errors."""
    return Republisher(node, open_bag(path), topics, rate)


def _find(name: str, bag: Bag) -> str:
    full = name if name.startswith('/') else f'/{name}'
    if full in bag.topics:
        return full
    hint = did_you_mean(full, bag.topics)
    raise ChoiceError(f"{bag.path}: has no topic '{full}'{hint}; topics: {', '.join(bag.topics)}")


def _qos(name: str) -> Qos:
    """Return how a topic travels, whatever namespace it is in."""
    for known in _endings(name):
        try:
            return topic(known).qos
        except UnknownTopicError:
            continue
    return EVENT


def _endings(name: str) -> Iterator[str]:
    yield name
    parts = name.strip('/').split('/')
    for begin in range(len(parts)):
        yield '/'.join(parts[begin:])
