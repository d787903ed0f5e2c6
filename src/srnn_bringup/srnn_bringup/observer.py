# SPDX-License-Identifier: Apache-2.0
"""Listens to the graph on behalf of a recorder."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
import time
from typing import Any

import numpy as np
from rclpy.node import Node

from srnn_access import Key
from srnn_bringup.run_recorder import Recorder
from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.health import Health, in_namespace
from srnn_msgs_py.ros import diagnostics, dissonance, executed, result, segment, weights, wrench
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_node.inlet import Inlet

HISTORY = 100
"""Samples kept for a listener that wants all of them, however busy the machine is."""


class Observer:
    """Subscribes to what a report needs.

    Whatever cannot be read, or does not come from whom it may come, is left out.

    Attributes:
        recorder: gets what is heard.

    """

    def __init__(self, node: Node, recorder: Recorder, key: Key | None = None) -> None:
        """Hand to `recorder` what `node` hears, by the same rules as the nodes with this key."""
        self._node = node
        self._key = key
        self.recorder = recorder
        self._subscriptions = [
            self._listen('segment', segment.from_msg, recorder.segment),
            self._listen('executed', executed.from_msg, recorder.executed),
            self._listen('segment_result', result.from_msg, recorder.result),
            self._listen('dissonance', dissonance.from_msg, recorder.dissonance),
            self._listen('weights', weights.from_msg, recorder.weights),
            self._listen('contact_truth', _force, recorder.force),
            self._listen('/diagnostics', self._beside, recorder.health),
        ]

    def connected(self) -> bool:
        """Tell whether every topic has found its publisher."""
        return all(subscription.get_publisher_count() for subscription in self._subscriptions)

    def _beside(self, msg: Any) -> dict[str, Health]:
        """Read the health of the nodes of this graph; all graphs of a domain share the topic."""
        return in_namespace(diagnostics.from_msg(msg), self._node.get_namespace())

    def _listen(self, name: str, read: Callable[[Any], Any], take: Callable[[Any], None]) -> Any:
        row = topic(name)
        qos = profile(replace(row.qos, depth=max(row.qos.depth, HISTORY)))
        inlet = Inlet(row, self._node.resolve_topic_name(row.name), self._key)
        callback = partial(_hand_over, inlet, read, take)
        return self._node.create_subscription(
            message_type(row.type_name), row.name, callback, qos
        )


def _hand_over(
    inlet: Inlet, read: Callable[[Any], Any], take: Callable[[Any], None], msg: Any
) -> None:
    if inlet.judge(msg, time.monotonic(), time.time_ns()) is not None:
        return
    with suppress(MessageError):
        take(read(msg))


def _force(msg: Any) -> float:
    return float(np.linalg.norm(wrench.from_msg(msg).force))
