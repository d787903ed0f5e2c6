# SPDX-License-Identifier: Apache-2.0
"""A running graph is paused and resumed from another process, whoever has started it."""

from collections.abc import Iterator
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from std_srvs.srv import Trigger
from watched_graph import Watched, free_scene, watched_graph

from srnn_bringup.config import Configuration
from srnn_bringup.graph import describe, write_parameters
from srnn_bringup.live_graph import command
from srnn_bringup.restarts import Restarts
from srnn_bringup.supervisor import Supervisor

PATIENCE_S = 60.0

OTHER_DOMAIN = str(101 + int(os.environ['ROS_DOMAIN_ID']))
"""Where the graph of the other tests is not."""


@pytest.fixture(scope='module')
def configuration(tmp_path_factory) -> Configuration:
    return free_scene(tmp_path_factory.mktemp('scene'), velocity=0.1)


@pytest.fixture(scope='module')
def running(configuration) -> Iterator[Watched]:
    with watched_graph(configuration, Restarts()) as value:
        yield value


@pytest.fixture
def watched(running) -> Iterator[Watched]:
    """The graph in motion, before and after."""
    yield running
    for client in running.graph._clients:
        if client.state(running.pump, PATIENCE_S) != 'active':
            client.change('activate', running.pump, PATIENCE_S)
    running.call(Trigger, 'tracker/reset')
    running.first_executed(running.now())


def command_line(name: str) -> list[str]:
    return [sys.executable, '-m', 'srnn_bringup.cli', name]


def alone(name: str) -> tuple[int, str]:
    """Run a command; return its exit code and what it says."""
    done = subprocess.run(
        command_line(name), capture_output=True, text=True, timeout=PATIENCE_S
    )
    return done.returncode, done.stdout + done.stderr


def srnn(watched: Watched, name: str) -> list[str]:
    """Run a command to its end while the graph is listened to; return what it says."""
    process = subprocess.Popen(
        command_line(name), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    try:
        watched.until(lambda: process.poll() is not None, PATIENCE_S)
    finally:
        process.kill()
        said, _ = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 0, said
    return said.splitlines()


def test_a_paused_arm_stands_still_and_a_resumed_one_goes_on(watched):
    before = len(watched.lessons), len(watched.results)
    assert srnn(watched, 'pause') == ['planner paused', 'adapter paused', 'tracker paused']
    watched.spin(0.2)
    # The last segment was finished, and the adapter has heard of it.
    assert {s.stamp_ns for s in watched.segments} <= {r.stamp_ns for r in watched.results}
    learned = len(watched.lessons) - before[0]
    assert learned >= len(watched.results) - before[1] - 1
    heard = watched.segments, watched.commands, watched.poses, watched.results
    counts = [len(messages) for messages in heard]
    watched.spin(1.0)
    assert [len(messages) for messages in heard] == counts
    assert np.ptp([q for _, q in watched.joints[-200:]], axis=0).max() < 0.001
    assert watched.joints[-1][0] > watched.now() - 10**8, 'the arm reports no more'

    again = ['planner is inactive already', 'adapter is inactive already']
    assert srnn(watched, 'pause') == [*again, 'tracker is inactive already']
    resumed = ['tracker resumed', 'adapter resumed', 'planner resumed']
    began = watched.now()
    assert srnn(watched, 'resume') == ['sim_bridge is active already', *resumed]
    watched.first_executed(began)
    assert srnn(watched, 'resume') == [f'{name} is active already' for name in watched.graph.names]


def test_a_node_that_dies_in_a_pause_is_started_anew_and_stays_paused(watched):
    srnn(watched, 'pause')
    segments = len(watched.segments)
    dead = {name: watched.graph.pids[name] for name in ('planner', 'tracker', 'adapter')}
    for name in dead:
        watched.kill(name)
    guarded = watched.graph.pump
    assert guarded.until(lambda: not dead.items() & watched.graph.pids.items(), PATIENCE_S)
    watched.pids.update(watched.graph.pids.values())
    began = watched.now()

    def states() -> set[str]:
        told = [[h for t, h in watched.health[name] if t > began] for name in dead]
        return {healths[-1].values['state'] if healths else '' for healths in told}

    assert guarded.until(lambda: states() == {'inactive'}, PATIENCE_S)
    guarded.until(lambda: False, 2.0)
    assert states() == {'inactive'}
    assert len(watched.segments) == segments
    began = watched.now()
    srnn(watched, 'resume')
    watched.first_executed(began)


def test_an_active_planner_moves_nothing_while_the_tracker_is_inactive(watched):
    srnn(watched, 'pause')
    began = watched.now()
    planner = watched.graph._clients[-1]
    planner.change('activate', watched.pump, PATIENCE_S)
    watched.spin(3.0)
    assert planner.state(watched.pump, PATIENCE_S) == 'active'
    assert not [s for s in watched.segments if s.stamp_ns > began]
    assert np.ptp([q for _, q in watched.joints[-200:]], axis=0).max() < 0.001


def test_a_pause_ends_in_rest_even_if_the_tracker_has_been_stopped(watched):
    assert watched.call(Trigger, 'tracker/stop').success
    srnn(watched, 'pause')
    srnn(watched, 'resume')
    assert watched.stands_still()


def test_without_a_graph_pause_and_resume_say_so(monkeypatch):
    monkeypatch.setenv('ROS_DOMAIN_ID', OTHER_DOMAIN)
    words = f'no graph in ROS_DOMAIN_ID = {OTHER_DOMAIN}: start one with `srnn up`'
    for name in ('pause', 'resume'):
        assert alone(name) == (1, f'srnn {name}: {words}\n')


@pytest.mark.slow
def test_a_part_that_was_started_by_something_else_can_be_paused(
    configuration, tmp_path, monkeypatch
):
    """As the launch file does: every node brings itself up."""
    monkeypatch.setenv('ROS_DOMAIN_ID', OTHER_DOMAIN)
    nodes = [n for n in describe(configuration) if n.name in ('sim_bridge', 'tracker')]
    files = write_parameters(nodes, tmp_path, autostart=True)
    with Supervisor(tmp_path) as supervisor:
        for node in nodes:
            supervisor.start(command(node, files[node.name]))
        end = time.monotonic() + PATIENCE_S
        for line in ('tracker paused\n', 'sim_bridge is active already\ntracker resumed\n'):
            name = 'pause' if line.endswith('paused\n') else 'resume'
            said = ''
            while line not in said:
                assert time.monotonic() < end, said
                _, said = alone(name)
