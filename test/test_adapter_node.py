# SPDX-License-Identifier: Apache-2.0
"""The adapter's node: kept before it is shared, and no fault of the disk ends it."""

from collections.abc import Callable, Iterator
import errno
import os
from pathlib import Path

import numpy as np
import pytest
import rclpy
from rclpy.lifecycle import TransitionCallbackReturn

from srnn_msgs_py.health import HealthLevel
from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_node import garbage
from srnn_planner.core import checkpoint, weights_file
from srnn_planner.nodes.adapter_node import AdapterNode

SUCCESS, FAILURE = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE

Start = Callable[..., AdapterNode]


@pytest.fixture
def start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Start]:
    """Start an adapter, in place of the one before, which goes as if it had been killed."""
    monkeypatch.setattr(AdapterNode, 'ACTIVE_PRIORITY', 0)
    nodes = []

    def end() -> None:
        for node in nodes:
            node.destroy_node()
            garbage.thaw()

    def begin(active: bool = True) -> AdapterNode:
        end()
        nodes[:] = [AdapterNode()]
        if active:
            assert nodes[0].trigger_configure() == SUCCESS
            assert nodes[0].trigger_activate() == SUCCESS
        return nodes[0]

    rclpy.init(args=['--ros-args', '-p', f'checkpoint:={tmp_path / "c"}'])
    yield begin
    end()
    rclpy.shutdown()


def touch(adapter: AdapterNode, stamp: int) -> None:
    """Let the adapter hear of a segment that ends in a contact."""
    plan = np.linspace([-0.1, 0.001 * stamp], [0.05, 0.001 * stamp], 30)
    path = plan.copy()
    path[12:] = plan[12]
    times, zeros = np.linspace(0.0, 1.0, 30), np.zeros_like(plan)
    adapter._on_segment(Segment(stamp, times, plan, zeros, zeros))
    adapter._on_executed(ExecutedPath(stamp, times, path))


def test_weights_are_on_the_disk_before_anybody_has_them(start, tmp_path, monkeypatch):
    adapter, seen = start(), []

    def look(_):
        seen.append(checkpoint.load(tmp_path / 'c').weights.version)

    for publisher in (adapter._weights, adapter._dissonance):
        monkeypatch.setattr(publisher, 'publish', look)
    touch(adapter, 1)
    touch(adapter, 2)
    adapter._on_refused(WeightsRefusal(2, 1, 'dead'))
    assert seen == [1, 1, 2, 2, 3]
    assert adapter.health().values['checkpoint_version'] == 3


def test_a_restarted_adapter_goes_on_and_learns_no_pair_twice(start, tmp_path):
    adapter = start()
    touch(adapter, 1)
    plan = np.linspace([0.0, 0.0], [0.1, 0.0], 30)
    times, zeros = np.linspace(0.0, 1.0, 30), np.zeros_like(plan)
    adapter._on_segment(Segment(2, times, plan, zeros, zeros))
    restarted = start()
    # Its plan was heard by the one that is gone.
    restarted._on_executed(ExecutedPath(2, times, plan))
    touch(restarted, 1)
    health = restarted.health()
    assert (health.values['updates'], health.values['weights_version']) == (1, 1)
    assert (health.level, health.message) == (HealthLevel.OK, '')
    assert restarted.refused_messages == 0
    touch(restarted, 3)
    assert checkpoint.load(tmp_path / 'c').weights.version == 2


def test_on_a_full_disk_learning_goes_on_and_says_so(start, tmp_path, monkeypatch):
    adapter = start()
    touch(adapter, 1)

    def full(*_):
        raise OSError(errno.ENOSPC, 'No space left on device')

    with monkeypatch.context() as patch:
        patch.setattr(os, 'fsync', full)
        touch(adapter, 2)
    health = adapter.health()
    assert health.level is HealthLevel.WARN
    assert 'No space left on device' in health.message
    assert health.values['checkpoint_error'] == health.message
    assert (health.values['weights_version'], health.values['checkpoint_version']) == (2, 1)
    touch(adapter, 3)
    assert adapter.health().level is HealthLevel.OK
    assert checkpoint.load(tmp_path / 'c').weights.version == 3


def test_a_broken_checkpoint_is_reported_and_the_one_before_is_used(start, tmp_path):
    adapter = start()
    touch(adapter, 1)
    touch(adapter, 2)
    (tmp_path / 'c').write_bytes(b'broken')
    health = start().health()
    assert health.level is HealthLevel.WARN
    assert 'c kept as c.broken' in health.message
    assert (health.values['weights_version'], health.values['checkpoint_version']) == (1, 1)
    assert (tmp_path / 'c.broken').read_bytes() == b'broken'


def test_a_checkpoint_that_is_a_folder_is_a_mistake_to_be_mended(start, tmp_path):
    (tmp_path / 'c').mkdir()
    adapter = start(active=False)
    assert adapter.trigger_configure() == FAILURE
    assert 'c is no regular file' in adapter.failure
    (tmp_path / 'c').rmdir()
    assert adapter.trigger_configure() == SUCCESS


def test_weights_that_were_left_are_kept_and_told_of(start, tmp_path):
    adapter = start()
    touch(adapter, 1)
    touch(adapter, 2)
    dead = adapter._session.learner.synapses.learned
    adapter._on_refused(WeightsRefusal(2, 1, 'no plan'))
    health = adapter.health()
    assert health.level is HealthLevel.WARN
    assert health.message == (
        'left weights version 2 for earlier ones, now version 3: no plan'
    )
    assert health.values['reverts'] == 1
    assert weights_file.load(tmp_path / 'c.refused').learned.same_as(dead)
    touch(adapter, 3)
    assert adapter.health().level is HealthLevel.OK


def test_its_parameters_can_be_asked_for_in_every_state(start):
    adapter = start()
    assert adapter.get_parameter('seed').value == 0
    assert adapter.trigger_deactivate() == SUCCESS
    assert adapter.trigger_cleanup() == SUCCESS
    assert adapter.trigger_configure() == SUCCESS
