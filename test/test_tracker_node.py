# SPDX-License-Identifier: Apache-2.0
"""What the tracker's node does between two states."""

from collections.abc import Iterator
from dataclasses import replace
import os
from pathlib import Path
import subprocess
import sys
import time
from types import SimpleNamespace

import numpy as np
import pytest
import rclpy
from rclpy.lifecycle import TransitionCallbackReturn
from slept_clock import SleptClock
from std_srvs.srv import Trigger

from lwr_description import Mount
from lwr_tracking import tracker_node
from lwr_tracking.core import silence_watch
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.tracker_node import TrackerNode
from srnn_msgs_py.health import HealthLevel
from srnn_msgs_py.joints import JointSample

sys.path.insert(0, str(Path(__file__).parents[1] / 'src' / 'lwr_tracking' / 'test'))
from segments import line

SUCCESS = TransitionCallbackReturn.SUCCESS

COMPILED_WHEN_ACTIVE = """
from numba.core import event
import rclpy
from test_tracker_node import at_rest
from lwr_tracking.tracker_node import TrackerNode
rclpy.init()
node = TrackerNode()
with event.install_recorder('numba:compile') as before:
    node.trigger_configure()
with event.install_recorder('numba:compile') as after:
    node.trigger_activate()
    for _ in range(5):
        node._on_sample(at_rest())
print(len(before.buffer), len(after.buffer))
"""


def at_rest() -> JointSample:
    zero = np.zeros(7)
    return JointSample(1, np.array(Mount().home), zero, zero.copy(), zero.copy())


@pytest.fixture
def tracker() -> Iterator[TrackerNode]:
    rclpy.init(args=[])
    node = TrackerNode()
    assert node.trigger_configure() == SUCCESS
    yield node
    node.destroy_node()
    rclpy.shutdown()


def test_joint_states_of_before_the_activation_are_not_missed_after_it(tracker, monkeypatch):
    """However long the activation takes, and whatever was heard before it."""
    monkeypatch.setattr(silence_watch, 'SILENCE', 0.0)
    for _ in range(2):
        tracker._on_sample(at_rest())
        time.sleep(0.01)
        assert tracker.trigger_activate() == SUCCESS
        assert tracker.seconds_to_tick() is None
        tracker._on_sample(at_rest())
        assert tracker.seconds_to_tick() <= 0.0
        assert tracker.trigger_deactivate() == SUCCESS


def test_without_joint_states_the_arm_is_stopped(tracker):
    assert tracker.trigger_activate() == SUCCESS
    tracker._on_sample(at_rest())
    tracker.on_tick()
    assert tracker._session.tracker.conditions == Condition.SILENT
    assert tracker.health().message == 'no joint states'


@pytest.mark.parametrize(('silence', 'stopped'), [(0.9, False), (1.1, True)])
def test_a_joint_state_after_a_long_silence_stops_the_arm_before_it_is_answered(
    tracker, monkeypatch, silence, stopped
):
    """As a process that has slept reads what has waited for it before its watch is asked."""
    clock = SleptClock()
    monkeypatch.setattr(tracker_node, 'time', clock)
    assert tracker.trigger_activate() == SUCCESS
    sent = []
    monkeypatch.setattr(tracker._topics.commands, 'publish', sent.append)
    tracker._on_sample(at_rest())
    clock.sleep(silence)
    tracker._on_sample(replace(at_rest(), stamp_ns=1 + round(1e9 * silence)))
    assert (Condition.SILENT in tracker._session.tracker.conditions) == stopped
    assert len(sent) == (1 if stopped else 2)


def test_deactivation_in_mid_motion_is_a_rest_on_the_path_and_no_fault(tracker, monkeypatch):
    clock = SleptClock()
    monkeypatch.setattr(tracker_node, 'time', clock)
    assert tracker.trigger_activate() == SUCCESS
    sample = at_rest()
    tracker._on_sample(sample)
    start = tuple(tracker._session.tracker.tip[:2])
    assert tracker._session.tracker.offer(line(start, (0.2, 0.0), 0.2), 0.0) is None
    for _ in range(200):
        clock.sleep(0.004)
        sample = tracker._session.assumed(sample, sample.stamp_ns + 4_000_000)
        tracker._on_sample(sample)
    assert np.linalg.norm(tracker._session.tracker.reference.velocity) > 0.15
    assert tracker.trigger_deactivate() == SUCCESS
    assert tracker._session.tracker.reference.at_rest
    assert tracker._session.tracker.reference.running is not None
    assert not tracker._session.tracker.latched
    assert not tracker.health().message


def told(node, name):
    (service,) = (s for s in node.services if s.service_name == f'/tracker/{name}')
    return service.callback(Trigger.Request(), Trigger.Response())


def test_a_stop_outlives_deactivation_and_process(tmp_path):
    rclpy.init(args=['--ros-args', '-p', f'latch:={tmp_path / "latch"}'])
    try:
        first = TrackerNode()
        first.trigger_configure()
        first.trigger_activate()
        first._on_sample(at_rest())
        assert told(first, 'stop').success
        first.trigger_deactivate()
        first.trigger_activate()
        first._on_sample(at_rest())
        assert first._session.tracker.conditions == Condition.STOPPED
        # Not shut down: killed.
        second = TrackerNode()
        second.trigger_configure()
        assert second.health().level is HealthLevel.ERROR
        second.trigger_activate()
        second._on_sample(at_rest())
        assert second._session.tracker.conditions == Condition.STOPPED
        assert told(second, 'reset').success
        third = TrackerNode()
        third.trigger_configure()
        third.trigger_activate()
        assert not third._session.tracker.latched
        for node in (first, second, third):
            node.destroy_node()
    finally:
        rclpy.shutdown()


def test_stop_works_while_the_tracker_is_inactive(tracker):
    assert not told(tracker, 'reset').success
    stopped = told(tracker, 'stop')
    assert stopped.success
    assert stopped.message == 'frozen until reset, once it is active'
    assert tracker.trigger_activate() == SUCCESS
    tracker._on_sample(at_rest())
    assert tracker._session.tracker.conditions == Condition.STOPPED
    assert told(tracker, 'reset').success
    assert not tracker._session.tracker.latched


def test_nothing_is_compiled_once_the_tracker_is_configured(tmp_path):
    environment = {**os.environ, 'NUMBA_CACHE_DIR': str(tmp_path)}
    done = subprocess.run(
        [sys.executable, '-c', COMPILED_WHEN_ACTIVE], cwd=os.path.dirname(__file__),
        env=environment, capture_output=True, text=True, timeout=120, check=True,
    )  # fmt: skip
    before, after = map(int, done.stdout.split()[-2:])
    assert before > 0
    assert after == 0


def test_what_stops_the_arm_is_logged_once(tracker, monkeypatch):
    said = []
    assert tracker.trigger_activate() == SUCCESS
    monkeypatch.setattr(tracker, 'get_logger', lambda: SimpleNamespace(error=said.append))
    for _ in range(3):
        tracker._on_sample(replace(at_rest(), position=np.full(7, np.nan)))
    assert said == ['frozen until reset: measurement is not finite']
    tracker._stop()
    assert said[1:] == ['frozen until reset: stop asked for, measurement is not finite']


def test_after_a_silence_nothing_is_commanded_until_reset_and_then_the_arm_as_it_is(
    tracker, monkeypatch
):
    """It may be another arm that reports again: a new simulation starts somewhere else."""
    told = []
    assert tracker.trigger_activate() == SUCCESS
    monkeypatch.setattr(tracker._topics, 'commands', SimpleNamespace(publish=told.append))
    tracker._on_sample(at_rest())
    assert len(told) == 1
    for _ in range(2):
        tracker.on_tick()
    elsewhere = replace(at_rest(), stamp_ns=2, position=np.array(Mount().home) + 0.1)
    tracker._on_sample(elsewhere)
    assert len(told) == 1
    assert tracker._session.tracker.counters.faults == 2
    tracker._session.pause()
    tracker._reset()
    for _ in range(2):
        tracker._on_sample(elsewhere)
    np.testing.assert_allclose(told[1].data, elsewhere.position)
    np.testing.assert_allclose(told[2].data, elsewhere.position, atol=1e-3)
    assert tracker._session.tracker.conditions == Condition.PAUSED
    assert tracker._session.tracker.counters.faults == 2


def test_a_reset_without_need_changes_nothing(tracker):
    assert tracker.trigger_activate() == SUCCESS
    tracker._on_sample(at_rest())
    core = tracker._session.tracker
    tracker._reset()
    assert tracker._session.tracker is core
