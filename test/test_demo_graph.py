# SPDX-License-Identifier: Apache-2.0
"""`srnn demo` and `srnn up` as a user runs them: real processes, real middleware."""

from collections.abc import Iterator
import json
import os
from pathlib import Path
import signal

import pytest
from srnn_process import RUN_S, SCENE, START_S, STOP_S, commands_in, nothing_left

from srnn_planner.core import weights_file

MODULES = ('bridge_node', 'tracker_node', 'adapter_node', 'planner_node')
NODES = {'sim_bridge', 'tracker', 'adapter', 'planner'}


@pytest.fixture
def start(tmp_path: Path) -> Iterator:
    with commands_in(tmp_path) as run:
        yield run


def test_demo_runs_learns_and_reports(start, tmp_path):
    srnn = start(
        'demo', '--scene', 'wall.yaml', '--segments', '14', '--seed', '2',
        '--json', 'demo.json', '--save-weights', 'weights.npz',
    )  # fmt: skip
    srnn.wait_for('segment  way point')
    assert set(srnn.pids) == set(MODULES)
    assert srnn.wait(RUN_S) == 0, srnn.text
    assert nothing_left(srnn, tmp_path)

    report = json.loads((tmp_path / 'demo.json').read_text())
    assert (report['scene'], report['signal'], report['seed']) == ('wall', 'local', 2)
    (trial,) = report['trials']
    assert trial['segments_executed'] == 14
    assert set(trial['nodes']) == NODES
    assert trial['contacts'] == len(trial['contact_segments']) >= 1, srnn.text
    assert 1 <= trial['updates_triggered'] <= 14
    assert trial['contact_force_peak_n'] > 1.0
    assert trial['invalid_plans'] == 0
    assert 0.0 < trial['planning_ms']['p50'] <= trial['planning_ms']['p99']
    assert trial['update_ms']['p50'] > 0.0
    assert 0.0 < trial['tracking_rmse_m'] < 0.005
    assert trial['planned_execution_s']['mean'] > 0.1
    assert trial['path_length_m'] > 0.1

    assert (tmp_path / 'demo.png').stat().st_size > 20_000
    version = weights_file.load(tmp_path / 'weights.npz').version
    assert version >= trial['updates_triggered']
    numbered = [line for line in srnn.lines if line[:7].strip().isdecimal()]
    assert [int(line[:7]) for line in numbered] == list(range(1, 15))
    assert srnn.text.count('touch ') >= trial['contacts']


def test_demo_names_the_node_that_was_killed(start, tmp_path):
    srnn = start('demo', '--segments', '500', '--json', 'demo.json')
    srnn.wait_for('\n      2  ')
    os.kill(srnn.pids['tracker_node'], signal.SIGKILL)
    assert srnn.wait(STOP_S) == 1
    assert 'srnn demo: tracker was killed by SIGKILL' in srnn.text
    assert nothing_left(srnn, tmp_path)
    assert json.loads((tmp_path / 'demo.json').read_text())['trials'][0]['segments_executed'] >= 2


def test_demo_stops_cleanly_when_interrupted(start, tmp_path):
    srnn = start('demo', '--segments', '500', '--json', 'demo.json')
    srnn.wait_for('\n      2  ')
    srnn.process.send_signal(signal.SIGINT)
    assert srnn.wait(STOP_S) == 128 + signal.SIGINT
    assert 'stopped by SIGINT' in srnn.text
    assert 'Traceback' not in srnn.text
    assert nothing_left(srnn, tmp_path)
    assert json.loads((tmp_path / 'demo.json').read_text())['trials'][0]['segments_executed'] >= 2
    assert (tmp_path / 'demo.png').is_file()


def test_demo_can_be_interrupted_before_anything_moves(start, tmp_path):
    srnn = start('demo', '--json', 'demo.json')
    srnn.wait_for('configuring')
    srnn.process.send_signal(signal.SIGINT)
    assert srnn.wait(STOP_S) == 128 + signal.SIGINT
    assert 'Traceback' not in srnn.text
    assert nothing_left(srnn, tmp_path)


def test_a_node_that_cannot_be_configured_is_named_with_its_reason(start, tmp_path):
    scene = SCENE + '  - {shape: polygon, points: [[0, 0], [1.0e-7, 0], [0, 1.0e-7]]}\n'
    (tmp_path / 'tiny.yaml').write_text(scene)
    srnn = start('demo', '--scene', 'tiny.yaml')
    assert srnn.wait(START_S) == 1
    assert 'srnn demo: sim_bridge refuses to configure' in srnn.text
    assert 'too small' in srnn.text
    assert nothing_left(srnn, tmp_path)


def test_up_keeps_the_graph_until_it_is_stopped_and_a_second_one_out(start, tmp_path):
    srnn = start('up', '--scene', 'wall.yaml')
    srnn.wait_for('Ctrl-C stops the graph')
    assert all(f'({pid})' in srnn.text for pid in srnn.pids.values())

    second = start('demo', '--scene', 'wall.yaml')
    assert second.wait(START_S) == 1
    assert 'another' in second.text
    assert 'choose another domain' in second.text

    assert srnn.process.poll() is None
    srnn.process.send_signal(signal.SIGINT)
    assert srnn.wait(STOP_S) == 0
    assert nothing_left(srnn, tmp_path)
