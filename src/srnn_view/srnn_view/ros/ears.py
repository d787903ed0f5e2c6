# SPDX-License-Identifier: Apache-2.0
"""Hears what a graph says, when asked to, and tells a run about it."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
import time
from typing import Any

from nav_msgs.msg import OccupancyGrid
import numpy as np
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from visualization_msgs.msg import MarkerArray

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.health import in_namespace
from srnn_msgs_py.ros import (
    belief,
    diagnostics,
    dissonance,
    joints,
    markers,
    path,
    result,
    samples,
    spikes,
    wrench,
)
from srnn_msgs_py.topics import topic
from srnn_node.polling import PolledTopic
from srnn_view.live_run import BeliefMap, LiveRun, Waypoint

EACH = 200
"""Messages that may wait where each of them counts."""


class Ears:
    """Listens for a run; what says nothing that can be drawn is left out."""

    def __init__(self, node: Node, run: LiveRun, names: Sequence[str]) -> None:
        """Listen from now on for an arm with joints of these names; have `listen` called."""
        self._run = run
        self._namespace = node.get_namespace()
        self._names = names
        tell: Mapping[str, Callable[[Any], None]] = {
            'segment_path': lambda msg: run.planned(path.positions(msg)),
            'executed_path': lambda msg: run.moved(path.positions(msg)),
            'segment_result': self._on_result,
            'dissonance': lambda msg: run.learned(dissonance.from_msg(msg)),
            '/diagnostics': self._on_diagnostics,
        }
        newest: Mapping[str, Callable[[Any], None]] = {
            'joint_states': self._on_joints,
            'wrench': self._on_wrench,
            'samples': lambda msg: run.imagined(*samples.from_msg(msg)),
            'spikes': lambda msg: run.spiked(spikes.from_msg(msg)),
            'belief': self._on_belief,
            'markers': self._on_markers,
        }
        self._topics = [
            (_of(node, name, depth), act)
            for depth, acts in ((EACH, tell), (1, newest)) for name, act in acts.items()
        ]  # fmt: skip

    def listen(self) -> None:
        """Tell the run what has been said since."""
        for polled, act in self._topics:
            for message in polled.fetch():
                with suppress(MessageError):
                    act(deserialize_message(message.data, polled.kind))

    def _on_joints(self, msg: Any) -> None:
        self._run.measured(joints.positions(msg, self._names))

    def _on_wrench(self, msg: Any) -> None:
        self._run.pressed(float(np.linalg.norm(wrench.from_msg(msg).force)))

    def _on_result(self, msg: Any) -> None:
        self._run.ended_as(result.from_msg(msg), time.monotonic())

    def _on_diagnostics(self, msg: Any) -> None:
        beside = in_namespace(diagnostics.from_msg(msg), self._namespace)
        self._run.felt(beside, time.monotonic())

    def _on_belief(self, msg: OccupancyGrid) -> None:
        self._run.believed(BeliefMap(*belief.from_msg(msg)))

    def _on_markers(self, msg: MarkerArray) -> None:
        self._run.toured(tuple(Waypoint(*point) for point in markers.from_msg(msg)))


def _of(node: Node, name: str, depth: int) -> PolledTopic:
    row = topic(name)
    # Of what is sent hundreds of times a second the newest will do; nobody sends it again.
    reliable = row.qos.latched or depth > 1
    return PolledTopic(node, row, replace(row.qos, depth=depth, reliable=reliable))
