# SPDX-License-Identifier: Apache-2.0
"""The running graph: it is what the README says, and it survives the loss of its planner."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
import time

import numpy as np
import pytest
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from std_srvs.srv import Trigger
from watched_graph import PATIENCE_S, Watched, free_scene, over, watched_graph

from srnn_bringup.arms import ARMS
from srnn_bringup.restarts import Restarts
from srnn_msgs_py.health import HealthLevel
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.ros import diagnostics, weights
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import TOPICS, markdown_table, topic
from srnn_msgs_py.weights import WeightsUpdate

ROOT = Path(__file__).parents[1]


@pytest.fixture
def watched(tmp_path: Path) -> Iterator[Watched]:
    with watched_graph(free_scene(tmp_path, velocity=0.1)) as value:
        yield value


@pytest.mark.parametrize('arm', ARMS)
def test_graph_is_the_table_of_the_readme(tmp_path, arm):
    assert markdown_table() in (ROOT / 'README.md').read_text(encoding='utf-8')
    with watched_graph(over(arm, free_scene(tmp_path, velocity=0.1))) as watched:
        watched.spin(1.0)
        check_table(watched.graph)


def check_table(graph):
    node, names = graph.node, set(graph.names)

    def ends(infos) -> set[str]:
        return {info.node_name for info in infos} & names

    for row in TOPICS:
        name = row.name if row.name.startswith('/') else f'/{row.name}'
        publishers = node.get_publishers_info_by_topic(name)
        subscribers = node.get_subscriptions_info_by_topic(name)
        assert ends(publishers) == set(row.publishers) & names, name
        assert ends(subscribers) == set(row.subscribers) & names, name
        for info in (*publishers, *subscribers):
            if info.node_name not in names:
                continue
            reliable = info.qos_profile.reliability == ReliabilityPolicy.RELIABLE
            latched = info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
            assert info.topic_type == row.type_name, name
            assert (reliable, latched) == (row.qos.reliable, row.qos.latched), name


def test_no_other_topics_than_those_of_the_table(watched):
    known = {row.name if row.name.startswith('/') else f'/{row.name}' for row in TOPICS}
    of_every_node = ('/rosout', '/parameter_events')
    for name, _ in watched.graph.node.get_topic_names_and_types():
        if name not in of_every_node and not name.endswith('/transition_event'):
            assert name in known


def test_arm_comes_to_rest_on_the_path_when_the_planner_is_killed_and_goes_on_with_a_new_one(
    watched,
):
    watched.kill('planner')
    killed = time.monotonic()
    # What it sent last may still be on its way.
    watched.spin(0.2)
    accepted = {s.stamp_ns: s for s in watched.segments}
    watched.until(lambda: accepted and set(accepted) <= {r.stamp_ns for r in watched.results})
    watched.spin(0.5)
    tail = np.array([p for t, p in watched.poses if t > watched.poses[-1][0] - 0.3])
    last = watched.segments[-1].positions[-1]
    assert np.ptp(tail, axis=0).max() < 0.0005
    assert np.linalg.norm(tail[-1, :2] - last) < 0.003
    moved = np.array([p[:2] for t, p in watched.poses if t > killed])
    planned = np.vstack([s.positions for s in watched.segments[-3:]])
    off = np.linalg.norm(moved[:, None] - planned[None], axis=2).min(axis=1)
    assert off.max() < 0.005

    known = {s.stamp_ns for s in watched.segments}
    began = time.monotonic()
    watched.graph.restart('planner')
    new = lambda: [stamp for stamp in watched.done() if stamp not in known]  # noqa: E731
    watched.until(lambda: len(new()) >= 2)
    to_steady = time.monotonic() - time.time() - began
    first = min(s.stamp_ns for s in watched.segments if s.stamp_ns not in known)
    print(
        f'planner killed: its successor sent a segment after {1e-9 * first + to_steady:.2f} s, '
        f'one that was executed after {1e-9 * new()[0] + to_steady:.2f} s'
    )


def test_motion_goes_on_undisturbed_when_the_adapter_is_killed(watched):
    watched.kill('adapter')
    before = len(watched.done())
    watched.until(lambda: len(watched.done()) >= before + 4)
    codes = {r.code for r in watched.results}
    assert not codes & {ResultCode.BLOCKED, ResultCode.FAULT}
    # A pause of the whole machine may make one planner late, the adapter must make none.
    from_rest = [s for s in watched.segments if not s.velocities[0].any()]
    assert len(from_rest) <= 2


def test_an_adapter_that_was_killed_goes_on_from_its_last_update(watched):
    heard = []
    watched.listen('weights', weights.from_msg, heard.append)
    assert watched.call(Trigger, 'adapter/revert').success
    watched.until(lambda: heard and heard[-1].version == 1)
    watched.kill('adapter')
    watched.until(lambda: not watched.graph._supervisor.alive('adapter'))
    heard.clear()
    watched.graph.restart('adapter')
    watched.until(lambda: heard)
    assert heard[0].version == 1


@pytest.mark.parametrize('name', ['planner', 'adapter'])
def test_a_dead_node_is_started_anew_and_reported(watched, name):
    said = []
    watched.graph._restarts, watched.graph._say = Restarts(), said.append
    watched.kill(name)
    assert watched.graph.pump.until(lambda: said, PATIENCE_S)
    assert f'{name} was killed by SIGKILL' in said[0]
    assert f'starting {name} anew' in said[0]
    before = len(watched.segments)
    assert watched.graph.pump.until(lambda: len(watched.segments) >= before + 2, PATIENCE_S)
    assert watched.graph._supervisor.alive(name)
    assert len(said) == 1


def test_dead_weights_are_left_reported_and_outlived(watched):
    heard, health = [], {f'/{name}': [] for name in watched.graph.names}
    watched.listen('weights', weights.from_msg, heard.append)
    watched.listen('/diagnostics', diagnostics.from_msg, lambda told: [
        health[name].append(value) for name, value in told.items()
    ])
    planner, adapter = health['/planner'], health['/adapter']
    watched.until(lambda: heard and planner and adapter)
    good = heard[-1].learned
    row = topic('weights')
    publisher = watched.graph.node.create_publisher(
        message_type(row.type_name), row.name, profile(row.qos)
    )
    watched.until(publisher.get_subscription_count)
    everywhere = np.full(good.neurons**2, -1.0, np.float32)
    dead = WeightsUpdate(
        100, 0, replace(good, synapses=np.arange(good.neurons**2), values=everywhere)
    )
    publisher.publish(weights.to_msg(dead))
    watched.until(lambda: any(h.level is HealthLevel.ERROR for h in planner))
    assert next(h for h in planner if h.level is HealthLevel.ERROR).message == (
        'no valid plan in 10 tries with weights version 100: trying older ones'
    )
    watched.until(lambda: heard[-1].version == 101)
    assert heard[-1].learned.same_as(good)
    before = len(watched.done())
    watched.until(lambda: len(watched.done()) >= before + 2)
    watched.until(lambda: planner[-1].level is not HealthLevel.ERROR)
    assert planner[-1].values['weights_version'] == '101'
    assert planner[-1].values['weights_refused'] == '1'
    watched.until(lambda: adapter[-1].values['weights_version'] == '101')
    assert adapter[-1].level is HealthLevel.WARN
    assert 'no valid plan in 10 tries with weights version 100' in adapter[-1].message
    assert adapter[-1].values['checkpoint_version'] == '101'
    assert adapter[-1].values['checkpoint_error'] == ''


def test_stop_freezes_the_arm_until_reset_and_then_it_goes_on(watched):
    assert watched.call(Trigger, 'tracker/stop').success
    watched.until(lambda: any(r.code is ResultCode.FAULT for r in watched.results))
    assert watched.stands_still()
    watched.until(lambda: watched.results[-1].code is ResultCode.REJECTED)
    before = len(watched.done())
    assert watched.call(Trigger, 'tracker/reset').success
    watched.until(lambda: len(watched.done()) >= before + 2)


def test_pause_brings_the_arm_to_rest_and_resume_lets_it_go_on(watched):
    assert watched.call(Trigger, 'tracker/pause').success
    assert watched.stands_still()
    before = len(watched.done())
    assert watched.call(Trigger, 'tracker/resume').success
    watched.until(lambda: len(watched.done()) >= before + 2)
    assert not any(r.code is ResultCode.FAULT for r in watched.results)


def test_weights_can_be_reverted_but_not_saved_without_a_file(watched):
    assert watched.call(Trigger, 'adapter/revert').success
    refused = watched.call(Trigger, 'adapter/save')
    assert not refused.success
    assert 'weights_file' in refused.message
    running = watched.call(Trigger, 'sim_bridge/reset')
    assert not running.success
    assert 'deactivate' in running.message
