# SPDX-License-Identifier: Apache-2.0
"""The graph over two hosts, as the README says, and over a link that is cut and comes back."""

from collections.abc import Iterator
from ipaddress import ip_address
import math
import os
from pathlib import Path
import re
import shlex
import signal
import sys
import time
from types import SimpleNamespace

from host_process import HostProcess, Tap
import numpy as np
import pytest
from two_hosts import Host, two_hosts, why_not

from srnn_bringup.environment import DISCOVERY_RANGE, PROFILES, graph_environment
from srnn_bringup.peer_profile import peer_profile
from srnn_bringup.peers import Peer

ROOT = Path(__file__).parents[2]
START_S = 120.0
PATIENCE_S = 60.0
UP = 'Ctrl-C stops the graph'

BLIND_AFTER_S = 1.5
"""No segment is planned once the arm has not been heard of for so long [s]."""

SHORT_CUT_S = 3.0
LONG_CUT_S = 25.0
"""Whom the graph has not heard for 5 s it forgets; the middleware would for 20 s."""

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(bool(why_not()), reason=f'no two hosts here: {why_not()}'),
]


def srnn(host: Host, line: str, folder: Path) -> HostProcess:
    """Run a command line of a user on a host."""
    _, *arguments = shlex.split(line, comments=True)
    command = [sys.executable, '-m', 'srnn_bringup.cli', *arguments]
    return HostProcess(host, command, {'TMPDIR': str(folder)})


def tap(host: Host) -> Tap:
    """Listen to the part of the graph that runs on a host."""
    return Tap(host, graph_environment(os.environ))


def commands_of_the_readme() -> list[str]:
    return re.findall(r'^srnn up --only .*$', (ROOT / 'README.md').read_text(), re.MULTILINE)


@pytest.fixture(scope='module')
def hosts(tmp_path_factory) -> Iterator:
    with two_hosts(tmp_path_factory.mktemp('hosts')) as value:
        yield value


@pytest.fixture(scope='module')
def graph(hosts, tmp_path_factory) -> Iterator:
    """The graph as the README starts it, in motion, with something learned."""
    folder = tmp_path_factory.mktemp('graph')
    on_arm, on_brain = commands_of_the_readme()
    with (
        srnn(hosts.arm, on_arm, folder) as arm, srnn(hosts.brain, on_brain, folder) as brain,
        tap(hosts.arm) as at_arm, tap(hosts.brain) as at_brain,
    ):  # fmt: skip
        for process in (arm, brain):
            process.wait_for(UP, START_S)
        at_brain.until(lambda: any(w['version'] for w in at_brain.heard('weights')), PATIENCE_S)
        yield SimpleNamespace(
            hosts=hosts, arm=arm, brain=brain, at_arm=at_arm, at_brain=at_brain
        )
    assert (arm.process.returncode, brain.process.returncode) == (0, 0)


def tips(heard: Tap) -> tuple[np.ndarray, np.ndarray]:
    """Return times (n,) [s] and positions (n, 2) [m] of the tip."""
    poses = heard.heard('current_pose')
    return np.array([p['t'] for p in poses]), np.array([p['tip'][:2] for p in poses])


def speed(heard: Tap, since: float) -> float:
    """Return the highest speed [m/s] over ten poses by the time of their measurement."""
    poses = [p for p in heard.heard('current_pose') if p['t'] > since]
    times = 1e-9 * np.array([p['stamp'] for p in poses])
    places = np.array([p['tip'] for p in poses])
    steps = np.linalg.norm(places[10:] - places[:-10], axis=1)
    return float((steps / (times[10:] - times[:-10])).max())


def off(places: np.ndarray, segments: list[dict]) -> float:
    """Return how far from planned paths the tip was at most [m]."""
    dense = [np.linspace(a, b, 10) for s in segments
             for a, b in zip(s['positions'], s['positions'][1:], strict=False)]  # fmt: skip
    planned = np.vstack(dense)
    return float(np.linalg.norm(places[:, None] - planned[None], axis=2).min(axis=1).max())


def a_segment_begins(heard: Tap) -> bool:
    """Tell whether one segment has just ended, and the arm moves on in the next one."""
    results, poses = heard.heard('segment_result'), heard.heard('current_pose')
    if not results or time.monotonic() - results[-1]['t'] > 0.2:
        return False
    return math.dist(poses[-1]['tip'], poses[-4]['tip']) > 0.003


def goes_on(graph, since: float) -> None:
    """Wait until two segments that were planned after `since` have been executed."""

    def new() -> int:
        planned = {s['stamp'] for s in graph.at_brain.heard('segment') if s['t'] > since}
        ends = graph.at_arm.heard('segment_result')
        return sum(r['stamp'] in planned and r['code'] == 'DONE' for r in ends)

    graph.at_arm.until(lambda: new() >= 2, PATIENCE_S)


def versions(graph) -> tuple[int, int]:
    """Return the version of the weights that planner and adapter have told last."""
    told = graph.at_brain.heard('/diagnostics')
    last = {h['node']: int(h['values'].get('weights_version', -1)) for h in told}
    return last['planner'], last['adapter']


def cut(graph, seconds: float, entry) -> float:
    """Cut the link in the middle of a segment; return how long the arm rests after it is back."""
    graph.at_arm.until(lambda: a_segment_begins(graph.at_arm), PATIENCE_S)
    before, began = versions(graph), time.monotonic()
    graph.hosts.cut()
    time.sleep(seconds)
    back = time.monotonic()
    graph.hosts.mend()
    goes_on(graph, back)
    times, places = tips(graph.at_arm)
    meanwhile = places[(times > began) & (times <= back)]
    segments = graph.at_brain.heard('segment')
    assert not [s for s in segments if began + BLIND_AFTER_S < s['t'] < back], 'planned blindly'
    planned = [s for s in segments if s['t'] <= began]
    entry.deviation_mm = 1e3 * off(meanwhile, planned[-3:])
    entry.speed = speed(graph.at_arm, began)
    assert entry.deviation_mm <= 5.0
    assert entry.speed <= 0.25
    assert np.linalg.norm(meanwhile[-1] - meanwhile[0]) > 0.005, 'did not finish the segment'
    at_rest = meanwhile[-15:]
    assert np.ptp(at_rest, axis=0).max() < 0.0005
    assert min(versions(graph)) >= max(before) >= 1
    moved = np.linalg.norm(places - at_rest[-1], axis=1) > 0.001
    return float(times[(times > back) & moved][0] - back)


def traffic(graph) -> str:
    """Return what both hosts send, in words."""
    hosts = (graph.hosts.arm, graph.hosts.brain)
    before = np.array([host.sent() for host in hosts])
    time.sleep(5.0)
    packets, size = (np.array([host.sent() for host in hosts]) - before).sum(axis=0) / 5.0
    return f'{packets:.0f} packets/s, {8e-6 * size:.1f} Mbit/s'


def test_arm_comes_to_rest_on_its_path_when_the_link_is_cut_and_goes_on_when_it_is_back(
    graph, ledger
):
    print(f'{traffic(graph)} on the wire')
    for _ in range(ledger.repeats):
        with ledger.injection(6, f'link cut for {SHORT_CUT_S:g} s') as entry:
            print(f'goes on {cut(graph, SHORT_CUT_S, entry):.2f} s after the link is back')


def test_hosts_that_have_forgotten_each_other_find_each_other_again(graph, ledger):
    for _ in range(1 + ledger.repeats // 10):
        with ledger.injection(6, f'link cut for {LONG_CUT_S:g} s') as entry:
            print(f'goes on {cut(graph, LONG_CUT_S, entry):.2f} s after the link is back')


def test_the_whole_graph_can_be_paused_and_resumed_from_either_host(graph, tmp_path):
    with srnn(graph.hosts.brain, 'srnn pause --peer arm', tmp_path) as pause:
        assert pause.wait(PATIENCE_S) == 0, pause.text
    assert pause.lines == ['planner paused', 'adapter paused', 'tracker paused']
    paused = time.monotonic()
    with srnn(graph.hosts.arm, 'srnn resume --peer brain', tmp_path) as resume:
        assert resume.wait(PATIENCE_S) == 0, resume.text
    assert resume.lines[1:] == ['tracker resumed', 'adapter resumed', 'planner resumed']
    goes_on(graph, paused)


def test_nodes_that_die_while_the_link_is_cut_are_found_when_it_is_back(graph, ledger):
    for _ in range(ledger.repeats):
        with ledger.injection(6, 'tracker and planner killed while the link is cut'):
            graph.hosts.cut()
            for process, module in ((graph.arm, 'tracker_node'), (graph.brain, 'planner_node')):
                os.kill(process.child(module), signal.SIGKILL)
            time.sleep(10.0)
            back = time.monotonic()
            graph.hosts.mend()
            goes_on(graph, back)


def test_the_graph_runs_over_ipv6(hosts, tmp_path, monkeypatch):
    monkeypatch.setenv('ROS_DOMAIN_ID', str(101 + int(os.environ['ROS_DOMAIN_ID'])))
    profile = tmp_path / 'fastdds.xml'
    here, there = ip_address(hosts.arm.ipv6), ip_address(hosts.brain.ipv6)
    profile.write_text(peer_profile([Peer(there, here)], int(os.environ['ROS_DOMAIN_ID'])))
    monkeypatch.setenv(DISCOVERY_RANGE, 'LOCALHOST')
    heard = {DISCOVERY_RANGE: 'SYSTEM_DEFAULT', PROFILES: str(profile)}
    with (
        srnn(hosts.arm, f'srnn up --only sim_bridge,tracker --peer {there}', tmp_path) as arm,
        srnn(hosts.brain, f'srnn up --only planner,adapter --peer {here}', tmp_path) as brain,
        Tap(hosts.arm, heard) as tool,
    ):
        for process in (arm, brain):
            process.wait_for(UP, START_S)
        tool.until(
            lambda: any(r['code'] == 'DONE' for r in tool.heard('segment_result')), PATIENCE_S
        )
        assert tool.heard('segment')
