# SPDX-License-Identifier: Apache-2.0
"""Arm, tracker and planner with a key, in one process on the real middleware, and a stranger."""

from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, replace
import os
from pathlib import Path
import time
from typing import Any

import numpy as np
import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.signals import SignalHandlerOptions
from segments import line
from slept_clock import SleptClock

from lwr_description import JOINT_NAMES
from lwr_sim_bridge.bridge_node import BridgeNode
from lwr_tracking import tracker_node
from lwr_tracking.tracker_node import TrackerNode
from srnn_access import Key, Refusal, Source, key_file
from srnn_msgs_py.ros import commands, joints, segment, weights
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_msgs_py.weights import WeightsUpdate
from srnn_node.outlet import Outlet
from srnn_planner.core.synapses import Synapses
from srnn_planner.nodes.planner_node import PlannerNode

PATIENCE_S = 20.0
SETTLE_S = 0.1
LOST_S = 0.1
"""The first measurements may find no listener."""

SCENE = Path(__file__).parents[2] / 'config' / 'scenes' / 'four_waypoints.yaml'
START = (-0.03, 0.0)
END = (0.05, 0.0)
LISTENERS = {
    'segment': 'tracker',
    'joint_states': 'tracker',
    'weights': 'planner',
    'forward_position_controller/commands': 'sim_bridge',
}
"""What a stranger tries to command, and who would obey."""


class Sender:
    """Somebody with or without a key who sends whatever he likes."""

    def __init__(self, world: 'World', key: Key | None) -> None:
        self._world = world
        self._source = Source()
        self._outlets = {
            name: Outlet(topic(name), f'/{name}', self._source, key) for name in LISTENERS
        }

    def marked(self, name: str, msg: Any) -> Any:
        self._outlets[name].mark(msg, time.time_ns())
        return msg

    def sends(self, name: str, msg: Any) -> None:
        self._world.publishers[name].publish(self.marked(name, msg))


class World:
    """Time stands still for the arm unless `run` is called.

    Attributes:
        recorded: what an eavesdropper has heard, by topic, marks and codes included.
        publishers: how anybody sends, by topic.
        invited: a sender with the key of the nodes.

    """

    def __init__(self, folder: Path, keyed: bool = True) -> None:
        path = folder / 'graph.key'
        self.key = key_file.create(path) if keyed else None
        arguments = ['-p', f'planner:scene:={SCENE}', '-p', f'sim_bridge:scene:={SCENE}']
        arguments += ['-p', 'planner:model.network.neurons_per_dimension:=7']
        arguments += ['-p', f'key_file:={path}'] if keyed else []
        rclpy.init(
            args=['--ros-args', *arguments], domain_id=int(os.environ['ROS_DOMAIN_ID']),
            signal_handler_options=SignalHandlerOptions.NO,
        )  # fmt: skip
        self.bridge, self.tracker, self.planner = BridgeNode(), TrackerNode(), PlannerNode()
        # The whole process is not to take the processor from others.
        self.planner.ACTIVE_PRIORITY = 0
        self.nodes = {
            'sim_bridge': self.bridge, 'tracker': self.tracker, 'planner': self.planner,
        }  # fmt: skip
        # The tracker is late for nobody, however busy the machine is.
        self._clock = SleptClock()
        tracker_node.time = self._clock
        self._tool = rclpy.create_node('stranger', use_global_arguments=False)
        self._executor = EventsExecutor()
        for node in (*self.nodes.values(), self._tool):
            self._executor.add_node(node)
        self.recorded: dict[str, list[Any]] = {name: [] for name in LISTENERS}
        for name in LISTENERS:
            row = topic(name)
            self._tool.create_subscription(
                message_type(row.type_name), row.name, self.recorded[name].append,
                profile(row.qos),
            )  # fmt: skip
        self.publishers: dict[str, Any] = {}
        self.invited = Sender(self, self.key)
        self.begin()

    def begin(self) -> None:
        """Configure and activate the nodes; let them hear what is latched."""
        # Anew each time: within a process, Fast DDS loses the first message that a new
        # subscription gets of a publisher that has sent more than 5000.
        for name in LISTENERS:
            if name in self.publishers:
                self._tool.destroy_publisher(self.publishers[name])
            row = topic(name)
            self.publishers[name] = self._tool.create_publisher(
                message_type(row.type_name), row.name, profile(row.qos)
            )
        for node in self.nodes.values():
            assert node.trigger_configure() == TransitionCallbackReturn.SUCCESS, node.failure
            assert node.trigger_activate() == TransitionCallbackReturn.SUCCESS, node.failure
        report, topics = self.bridge._report, self.tracker._topics
        ways = (report.measured, topics.commands, *self.publishers.values())
        self.until(lambda: all(way.get_subscription_count() > 1 for way in ways))
        self.until(lambda: report.external.get_subscription_count() > 0)
        self.settle()

    def end(self) -> None:
        """Deactivate the nodes and clean up."""
        for node in self.nodes.values():
            node.trigger_deactivate()
            node.trigger_cleanup()

    def settle(self) -> None:
        """Let everything arrive that is on its way."""
        until = time.monotonic() + SETTLE_S
        self.until(lambda: time.monotonic() > until)

    def move(self) -> None:
        """Have the arm in the middle of a motion that was asked for by whoever may."""
        for heard in self.recorded.values():
            heard.clear()
        self.run(40)
        watch = self.planner._session.watched.watch
        counters = self.tracker._session.tracker.counters
        version = watch.in_use.version
        self.invited.sends('weights', self.message('weights'))
        self.until(lambda: watch.in_use.version == version + 1)
        self.invited.sends('segment', self.message('segment'))
        self.until(lambda: counters.accepted == 1)
        self.run(50)
        self.settle()
        assert not self.tracker._session.tracker.reference.at_rest

    def close(self) -> None:
        self.end()
        self._executor.shutdown()
        for node in (*self.nodes.values(), self._tool):
            node.destroy_node()
        rclpy.shutdown()
        tracker_node.time = time

    def until(self, condition: Callable[[], object]) -> None:
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end, 'waited in vain'
            self._executor.spin_once(timeout_sec=0.02)

    def run(self, cycles: int) -> None:
        """Let the arm live; the tracker answers every one of its measurements."""
        for _ in range(cycles):
            cycle, before = self.bridge._rate.taken, self.tracker._topics.ticks
            self._clock.sleep(0.004)
            self.until(lambda cycle=cycle: self._lives_on(cycle))
            late = time.monotonic() + LOST_S
            self.until(
                lambda before=before, late=late: self.tracker._topics.ticks > before
                or time.monotonic() > late
            )

    def refused(self, name: str) -> Counter[Refusal]:
        """Return how many messages of a topic its listener has refused, by reason."""
        return self._inlet(name).refused.copy()

    def tries(self, send: Callable[[str], None], times: int) -> None:
        """Send to every topic, again and again; wait each time until all were refused."""
        for _ in range(times):
            before = {name: self.refused(name).total() for name in LISTENERS}
            for name in LISTENERS:
                send(name)
            self.until(
                lambda before=before: all(
                    self.refused(name).total() > count for name, count in before.items()
                )
            )

    def snapshot(self) -> bytes:
        """Return what could have been moved, bit for bit."""
        tracker, arm, planner = self.tracker._session.tracker, self.bridge._arm, self.planner
        reference, sample = tracker.reference, self.tracker._watch.sample
        learned = planner._session.planner.synapses.learned
        numbers = [learned.synapses, learned.values, arm._gate.last, arm.data.qpos]
        if reference is not None:
            numbers += [reference.position, sample.position, sample.velocity]
        others = (
            planner._session.watched.watch.in_use.version, asdict(tracker.counters),
            dict(arm.refused),
            reference and (reference.running, reference.waiting), sample and sample.stamp_ns,
        )  # fmt: skip
        return b''.join([*(part.tobytes() for part in numbers), repr(others).encode()])

    def message(self, name: str) -> Any:
        """Return what would be obeyed: the tip moves, a joint turns, the weights change."""
        angles = self.bridge._arm._gate.last + 0.002
        if name == 'segment':
            now = self.tracker.get_clock().now().nanoseconds
            return segment.to_msg(line(START, END, 0.1, stamp_ns=now))
        if name == 'weights':
            planner = self.planner._session.planner
            halves = np.full((49, 49), 0.5, dtype=np.float32)
            learned = Synapses.of(planner.neurons.prior, halves).learned
            version = self.planner._session.watched.watch.in_use.version + 1
            return weights.to_msg(WeightsUpdate(version, 1, learned))
        if name == 'joint_states':
            sample = replace(self.tracker._watch.sample, position=angles)
            return joints.to_msgs(sample, JOINT_NAMES)[0]
        return commands.to_msg(angles)

    def _lives_on(self, before: int) -> bool:
        self.bridge.on_tick()
        return self.bridge._rate.taken > before

    def _inlet(self, name: str) -> Any:
        return self.nodes[LISTENERS[name]]._access._inlets[name]
