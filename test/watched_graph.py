# SPDX-License-Identifier: Apache-2.0
"""The running graph with an ear on it: everything that a test wants to know of it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
import os
from pathlib import Path
import signal
import time

import numpy as np
from rclpy.node import Node
from std_srvs.srv import Trigger
import yaml

from lwr_sim_bridge.fri.parameters import PatienceParameters
from lwr_tracking.core.failsafe import RULES, Condition
from srnn_bringup.config import FRI, Choices, Configuration, load
from srnn_bringup.live_graph import LiveGraph
from srnn_bringup.restarts import Restarts
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import Health
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import diagnostics, dissonance, executed, pose, result, segment, weights
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.ros.stamp import stamp_from_msg
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.topics import topic
from srnn_node.signals import StopRequest

ROOT = Path(__file__).parents[1]
PATIENCE_S = 30.0
HISTORY = 500
"""Messages kept for this process, which may have to wait for the processor."""

REPEATED_CONTACT = RULES[Condition.REPEATED].cause

REFUSED = (ResultCode.REJECTED, ResultCode.STALE)


class Watched:
    """A live graph and what is heard from it; times are of the system clock [ns]."""

    def __init__(self, graph: LiveGraph, guarded: bool) -> None:
        self.graph = graph
        self.pump = graph.pump if guarded else graph.pump.unguarded()
        self.pids = set(graph.pids.values())
        self.segments: list[Segment] = []
        self.executed: list[ExecutedPath] = []
        self.results: list[SegmentResult] = []
        self.weights: list[tuple[int, int]] = []
        self.lessons: list[Dissonance] = []
        self.poses: list[tuple[float, np.ndarray]] = []
        self.joints: list[tuple[int, np.ndarray]] = []
        self.commands: list[int] = []
        self.health: dict[str, list[tuple[int, Health]]] = {name: [] for name in graph.names}
        self.listen('segment', segment.from_msg, self.segments.append)
        self.listen('executed', executed.from_msg, self.executed.append)
        self.listen('segment_result', result.from_msg, self.results.append)
        self.listen('weights', _version, self.weights.append)
        self.listen('dissonance', dissonance.from_msg, self.lessons.append)
        self.listen('current_pose', pose.from_msg, self._on_pose)
        self.listen('joint_states', _joints, self.joints.append)
        self.listen(
            'forward_position_controller/commands', lambda _: time.time_ns(), self.commands.append
        )
        self.listen('/diagnostics', diagnostics.from_msg, self._on_health)

    @property
    def node(self) -> Node:
        return self.graph.node

    def until(self, condition: Callable[[], object], seconds: float = PATIENCE_S) -> None:
        assert self.pump.until(condition, seconds), f'waited in vain\n{self.story()}'

    def tracker_says(self, message: str) -> bool:
        heard = self.health['tracker']
        return bool(heard) and heard[-1][1].message == message

    def story(self) -> str:
        """Return what the graph did last, and how its nodes say they are."""
        lines = [f'{r.code.name} {r.reason}'.strip() for r in self.results[-6:]]
        said = {name: heard[-1][1] for name, heard in self.health.items() if heard}
        lines += [f'{name}: {told.level.name} {told.message}' for name, told in said.items()]
        return '\n'.join([f'{len(self.results)} results, at last:', *lines])

    def spin(self, seconds: float) -> None:
        self.pump.until(lambda: False, seconds)

    def done(self) -> list[int]:
        return [r.stamp_ns for r in self.results if r.code is ResultCode.DONE]

    def unheard(self, since: int) -> list[ExecutedPath]:
        """Return executions of segments that this process has not heard of.

        A node that was started anew may be known to the others before it is known here.
        """
        heard = {s.stamp_ns for s in self.segments}
        return [e for e in self.executed if e.stamp_ns >= since and e.stamp_ns not in heard]

    def kill(self, name: str, number: signal.Signals = signal.SIGKILL) -> int:
        """Send a signal to a node; return when."""
        os.kill(self.graph.pids[name], number)
        return time.time_ns()

    @staticmethod
    def now() -> int:
        return time.time_ns()

    def restart(self, name: str) -> int:
        """Start a node anew once it has gone; return when."""
        self.until(lambda: not self.graph._supervisor.alive(name))
        began = time.time_ns()
        self.graph.restart(name)
        self.pids.update(self.graph.pids.values())
        return began

    def call(self, kind, name, **fields):
        client = self.node.create_client(kind, name)
        self.until(client.service_is_ready)
        future = client.call_async(kind.Request(**fields))
        self.until(future.done)
        self.node.destroy_client(client)
        return future.result()

    def under_way(self, rng: np.random.Generator) -> int:
        """Wait until the arm is somewhere on a segment; return the time."""
        done = len(self.done())
        self.until(lambda: len(self.done()) >= done + 2)
        self.spin(rng.uniform(0.0, 0.3))
        return time.time_ns()

    def first_executed(self, since: int) -> int:
        """Wait until segments are executed again; return when the first of them was sent."""
        new = lambda: [stamp for stamp in self.done() if stamp > since]  # noqa: E731
        self.until(lambda: len(new()) >= 2)
        return new()[0]

    def stands_still(self) -> bool:
        self.spin(0.5)
        tail = np.array([p for t, p in self.poses if t > self.poses[-1][0] - 0.3])
        return bool(np.ptp(tail, axis=0).max() < 0.0005)

    def listen(self, name, read, take):
        row = topic(name)
        qos = profile(replace(row.qos, depth=HISTORY))
        self.node.create_subscription(
            message_type(row.type_name), row.name, lambda msg: take(read(msg)), qos
        )

    def _on_pose(self, tip):
        self.poses.append((time.monotonic(), tip.position))

    def _on_health(self, healths):
        for name, health in healths.items():
            self.health.setdefault(name.rpartition('/')[2], []).append((time.time_ns(), health))


@contextmanager
def watched_graph(
    configuration: Configuration, restarts: Restarts | None = None, attended: bool = False
) -> Iterator[Watched]:
    """Bring up a graph; when it is down again, none of its processes may be left.

    Args:
        configuration: what the nodes are told.
        restarts: starts dead nodes anew while the graph is watched; None: nobody does.
        attended: until it is under way, somebody resets a tracker that has touched the same
            place again and again.

    """
    with StopRequest() as stop, LiveGraph(configuration, stop, lambda _: None, restarts) as graph:
        folder = str(graph._files['planner'].parent)
        watched = Watched(graph, guarded=restarts is not None)
        graph.configure()
        graph.activate()
        under_way = lambda: len(watched.done()) >= 2  # noqa: E731
        if attended:
            watched.until(lambda: under_way() or watched.tracker_says(REPEATED_CONTACT))
            if not under_way():
                assert watched.call(Trigger, 'tracker/reset').success
        watched.until(under_way)
        yield watched
    left = [pid for pid in watched.pids if Path(f'/proc/{pid}').exists()]
    assert not left, f'processes {left} are left'
    assert not _running(folder)


def over(arm: str, configuration: Configuration) -> Configuration:
    """Return a configuration with another arm; that of FRI has its controller emulated.

    Both sides are patient: this machine may be busy, and without real-time rights.
    """
    fri = configuration.fri
    driver = replace(
        fri.fri,
        link=replace(fri.fri.link, time_out=1.0),
        safety=replace(fri.fri.safety, poor_cycles=100, patience=5.0),
    )
    patience = PatienceParameters(extrapolated=100, cap=200)
    fri = replace(fri, fri=driver, emulator=replace(fri.emulator, patience=patience))
    return replace(configuration, robot=arm, emulated=arm == FRI, fri=fri)


def free_scene(folder: Path, velocity: float) -> Configuration:
    """Return the configuration of the standard tour without obstacles."""
    scene = yaml.safe_load((ROOT / 'config/scenes/four_waypoints.yaml').read_text())
    scene.update(obstacles=[], velocity=velocity)
    path = folder / 'free.yaml'
    path.write_text(yaml.safe_dump(scene))
    return load(Choices(scene=str(path), seed=1))


def _version(msg):
    update = weights.from_msg(msg)
    return update.version, update.learned.checksum()


def _joints(msg):
    return stamp_from_msg(msg.header.stamp), np.array(msg.position)


def _running(folder: str) -> list[str]:
    """Return the command lines of processes that name a folder."""
    lines = []
    for process in Path('/proc').glob('[0-9]*/cmdline'):
        try:
            line = process.read_text()
        except OSError:
            continue
        if folder in line:
            lines.append(line)
    return lines
