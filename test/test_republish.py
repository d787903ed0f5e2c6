# SPDX-License-Identifier: Apache-2.0
"""A node that is fed from a bag does what it has done in the run, over real topics."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
import os
from pathlib import Path
import subprocess
import sys
import time
from types import SimpleNamespace
from typing import Any

import pytest
import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.node import Node
from srnn_process import RUN_S, SCENE, Srnn

from lwr_tracking import tracker_node
from lwr_tracking.tracker_node import TrackerNode
from srnn_bag import open_bag
from srnn_bag.attached import PARAMETERS
from srnn_bringup import cli
from srnn_bringup.environment import graph_environment
from srnn_bringup.session import session
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.journal import Deed, number
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.ros import result, weights
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_replay.joint_state_bytes import stamp_ns
from srnn_replay.recording import Recording

pytestmark = pytest.mark.slow

HISTORY = 100
SUCCESS = TransitionCallbackReturn.SUCCESS


@pytest.fixture(scope='module')
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the bag of a run into a wall."""
    folder = tmp_path_factory.mktemp('run')
    (folder / 'wall.yaml').write_text(SCENE)
    line = f'demo --scene {folder}/wall.yaml --segments 8 --seed 2 --picture {folder}/demo.png'
    assert cli.main([*line.split(), '--record', str(folder / 'bag')]) == 0
    return folder / 'bag'


@contextmanager
def adapter(bag: Path, folder: Path) -> Iterator[None]:
    """Run an adapter, told what it was told in the run."""
    file = folder / 'adapter.yaml'
    file.write_bytes(open_bag(bag).attachments[PARAMETERS.format('adapter')])
    command = [
        sys.executable, '-m', 'srnn_planner.nodes.adapter_node', '--ros-args',
        '--params-file', str(file), '-p', 'autostart:=true', '-p', 'checkpoint:=""',
    ]  # fmt: skip
    with subprocess.Popen(command, env=graph_environment(os.environ), cwd=folder) as process:
        try:
            yield
        finally:
            process.terminate()
            process.wait(timeout=30.0)


def heard(
    bag: Path, folder: Path, name: str, convert: Callable[[Any], Any], *arguments: str
) -> list[Any]:
    """Return what is said on a topic while the bag is published."""
    values: list[Any] = []
    row = topic(name)
    with session('listener', lambda: None) as (node, pump):
        subscription = node.create_subscription(
            message_type(row.type_name), row.name, lambda msg: values.append(convert(msg)),
            profile(replace(row.qos, depth=HISTORY)),
        )  # fmt: skip
        assert pump.until(lambda: node.count_publishers(row.name), 60.0)
        srnn = Srnn(folder, 'replay', str(bag), '--publish', *arguments)
        try:
            assert pump.until(lambda: srnn.process.poll() is not None, RUN_S), srnn.text
            assert srnn.wait(10.0) == 0, srnn.text
            assert 'not every topic has a listener' not in srnn.text
        finally:
            srnn.close()
        pump.until(lambda: False, 0.5)
        node.destroy_subscription(subscription)
    return values


def test_an_adapter_that_is_fed_from_the_bag_learns_the_recorded_weights(bag, tmp_path):
    with adapter(bag, tmp_path):
        found = heard(
            bag, tmp_path, 'weights', weights.from_msg,
            '--topic', 'segment', '--topic', 'executed', '--rate', '4',
        )  # fmt: skip
    recording = Recording(open_bag(bag), 'adapter', ('weights',), '/')
    expected = [d.value for d in recording.decoded('weights', weights.from_msg)]
    assert len(expected) >= 2
    assert [w.version for w in found] == [w.version for w in expected]
    for one, other in zip(found, expected, strict=True):
        assert one.learned.same_as(other.learned)


class RecordedClock:
    """The clocks of a tracker, as they were in the run."""

    def __init__(self) -> None:
        self.now = 0.0
        self.age = 0.0
        self.stamp_ns = 0

    def monotonic(self) -> float:
        return self.now

    def time_ns(self) -> int:
        return time.time_ns()

    def get_clock(self) -> SimpleNamespace:
        instant = SimpleNamespace(nanoseconds=self.stamp_ns + round(1e9 * self.age))
        return SimpleNamespace(now=lambda: instant)


def stamp_of(sample: JointSample | None) -> int | None:
    return None if sample is None else sample.stamp_ns


@pytest.fixture
def tracker(
    bag, tmp_path, monkeypatch
) -> Iterator[tuple[TrackerNode, RecordedClock, Node, EventsExecutor]]:
    """Return a tracker in this process, told what it was told in the run, and who feeds it."""
    clock = RecordedClock()
    monkeypatch.setattr(tracker_node, 'time', clock)
    file = tmp_path / 'tracker.yaml'
    file.write_bytes(open_bag(bag).attachments[PARAMETERS.format('tracker')])
    rclpy.init(args=['--ros-args', '--params-file', str(file), '-p', 'latch:=""'])
    node = TrackerNode()
    monkeypatch.setattr(node, 'get_clock', clock.get_clock)
    assert node.trigger_configure() == node.trigger_activate() == SUCCESS
    feeder, executor = rclpy.create_node('feeder'), EventsExecutor()
    executor.add_node(node)
    executor.add_node(feeder)
    yield node, clock, feeder, executor
    executor.shutdown()
    feeder.destroy_node()
    node.destroy_node()
    rclpy.shutdown()


def test_a_tracker_that_is_fed_from_the_bag_gives_the_recorded_results(bag, tracker):
    """In recorded time: by the clock of this machine it would meet the arm elsewhere."""
    node, clock, feeder, executor = tracker
    names = ('segment', 'joint_states', 'external_torque/joint_states', 'segment_result')
    recording = Recording(open_bag(bag), 'tracker', names, '/')
    by_stamp = {n: {stamp_ns(m.data): m.data for m in recording.raw(n)} for n in names[:3]}
    results = []
    out = {n: feeder.create_publisher(message_type(topic(n).type_name), n, profile(topic(n).qos))
           for n in names[:3]}  # fmt: skip
    row = topic('segment_result')
    feeder.create_subscription(
        message_type(row.type_name), row.name,
        lambda msg: results.append(result.from_msg(msg)), profile(replace(row.qos, depth=HISTORY)),
    )  # fmt: skip

    def until(condition):
        end = time.monotonic() + 10.0
        while not condition():
            assert time.monotonic() < end
            executor.spin_once(timeout_sec=0.1)

    until(lambda: all(p.get_subscription_count() for p in out.values()))
    until(lambda: feeder.count_publishers('segment_result'))
    (session,) = recording.sessions
    for deed, first, second, bits, _ in session.rows.tolist():
        if deed == Deed.MEASURED:
            clock.now = number(bits)
            out[names[2]].publish(by_stamp[names[2]][first + second])
            external = node._pairing.external
            until(lambda external=external: node._pairing.external is not external)
            out[names[1]].publish(by_stamp[names[1]][first])
            until(lambda first=first: stamp_of(node._watch.sample) == first)
        elif deed == Deed.OFFERED:
            clock.stamp_ns, clock.age = first, number(bits)
            offers = offered(node)
            out['segment'].publish(by_stamp['segment'][first])
            until(lambda offers=offers: offered(node) > offers)
        else:
            assert deed in (Deed.CONFIGURED, Deed.ACTIVATED, Deed.PAUSE, Deed.ASSUMED)
    expected = [d.value for d in recording.decoded('segment_result', result.from_msg)]
    until(lambda: len(results) >= len(expected))
    assert ResultCode.BLOCKED in {r.code for r in expected}
    assert results == expected


def offered(node: TrackerNode) -> int:
    counters = node._session.tracker.counters
    return counters.accepted + sum(counters.refused.values())


def test_a_topic_that_is_not_in_the_bag_is_named(bag, capfd):
    assert cli.main(['replay', str(bag), '--publish', '--topic', 'segmnt']) == 2
    assert "no topic '/segmnt' (did you mean '/segment'?)" in capfd.readouterr().err
