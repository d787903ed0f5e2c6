# SPDX-License-Identifier: Apache-2.0
"""A graph that names no other host cannot be seen or moved from one, whatever that host does."""

from collections.abc import Iterator
import os
from pathlib import Path
import sys

from host_process import HostProcess, Tap
import numpy as np
import pytest
from two_hosts import two_hosts, why_not

from srnn_bringup.environment import DISCOVERY_RANGE, PROFILES, graph_environment

ROOT = Path(__file__).parents[2]
SHOUT = Path(__file__).parent / 'wire_shout.py'
CLI = (sys.executable, '-m', 'srnn_bringup.cli')
START_S = 120.0
PATIENCE_S = 20.0
LISTEN_S = 8.0
"""Longer than any announcement takes; the tools of ROS announce themselves every 3 s."""

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(why_not()), reason=f'no two hosts here: {why_not()}'),
]


@pytest.fixture
def hosts(tmp_path) -> Iterator:
    with two_hosts(tmp_path) as value:
        yield value


def shouter(host, at: np.ndarray, environment: dict[str, str]) -> HostProcess:
    test = str(ROOT / 'src' / 'lwr_tracking' / 'test')
    path = os.pathsep.join((test, *filter(None, [os.environ.get('PYTHONPATH')])))
    return HostProcess(
        host, [sys.executable, str(SHOUT), *map(str, at)], {**environment, 'PYTHONPATH': path}
    )


def tip(heard: Tap) -> np.ndarray:
    return np.array(heard.heard('current_pose')[-1]['tip'][:2])


def test_a_stranger_sees_nothing_and_moves_nothing(hosts, tmp_path):
    """One who asks the whole network, names this host, and starts a graph that names it."""
    up = (*CLI, 'up', '--only', 'sim_bridge,tracker')
    near = graph_environment(os.environ)
    far = {DISCOVERY_RANGE: 'SUBNET', PROFILES: '', 'ROS_STATIC_PEERS': hosts.arm.ipv4}
    with (
        HostProcess(hosts.arm, up, {'TMPDIR': str(tmp_path)}) as arm,
        Tap(hosts.arm, near) as at_arm,
    ):
        arm.wait_for('Ctrl-C stops the graph', START_S)
        at_arm.until(lambda: at_arm.heard('current_pose'), PATIENCE_S)
        start = tip(at_arm)
        stranger = (*CLI, 'up', '--only', 'planner,adapter', '--peer', 'arm')
        with (
            HostProcess(hosts.brain, stranger, {'TMPDIR': str(tmp_path)}) as brain,
            Tap(hosts.brain, far) as at_brain,
            shouter(hosts.brain, start, far),
        ):
            brain.wait_for('Ctrl-C stops the graph', START_S)
            at_brain.until(lambda: at_brain.heard('segment'), PATIENCE_S)
            began = at_brain.heard('segment')[0]['t']
            at_brain.until(lambda: at_brain.heard('segment')[-1]['t'] > began + LISTEN_S, START_S)
            seen = {name for change in at_brain.heard('') for name in change['nodes']}
            assert 'planner' in seen
            assert not seen & {'sim_bridge', 'tracker'}
            own = {h['node'] for h in at_brain.heard('/diagnostics')}
            assert own == {'planner', 'adapter'}
            assert not at_brain.heard('current_pose')
            assert not at_arm.heard('segment')
            assert not at_arm.heard('segment_result')
            assert np.linalg.norm(tip(at_arm) - start) < 0.001
        # The same on the host of the arm is heard by all.
        with Tap(hosts.arm, {DISCOVERY_RANGE: 'SUBNET', PROFILES: ''}) as tool:
            tool.until(lambda: tool.heard('current_pose'), PATIENCE_S)
            with shouter(hosts.arm, start, near):
                at_arm.until(lambda: at_arm.heard('segment_result'), PATIENCE_S)
                at_arm.until(lambda: np.linalg.norm(tip(at_arm) - start) > 0.03, PATIENCE_S)


def test_a_graph_that_names_one_host_is_open_to_those_that_name_it_and_to_no_other(
    hosts, tmp_path
):
    up = (*CLI, 'up', '--only', 'sim_bridge,tracker', '--peer', '10.77.0.3')
    quiet = {DISCOVERY_RANGE: 'SUBNET', PROFILES: ''}
    with (
        HostProcess(hosts.arm, up, {'TMPDIR': str(tmp_path)}) as arm,
        Tap(hosts.brain, quiet) as unnamed,
    ):
        arm.wait_for('Ctrl-C stops the graph', START_S)
        with Tap(hosts.brain, {**quiet, 'ROS_STATIC_PEERS': hosts.arm.ipv4}) as naming:
            naming.until(lambda: naming.heard('current_pose'), PATIENCE_S)
            heard = len(naming.heard('current_pose'))
            later = heard + round(50 * LISTEN_S)
            naming.until(lambda: len(naming.heard('current_pose')) > later, START_S)
        assert not unnamed.heard('current_pose')
        assert not {'sim_bridge', 'tracker'} & {
            name for change in unnamed.heard('') for name in change['nodes']
        }
