# SPDX-License-Identifier: Apache-2.0
import json

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest
from synthetic_run import Player, planner_health

from srnn_bringup.closing_lines import closing_lines
from srnn_bringup.run_recorder import Recorder
from srnn_bringup.trial import Run, document, figures
from srnn_experiments.spread import mean_sd, spread

NODES = ('sim_bridge', 'tracker', 'adapter', 'planner')
HEALTH = {
    'planned': '6', 'invalid_plans': '0', 'deadline_misses': '1', 'planning_ms_mean': '1.5',
    'planning_ms_sd': '0.5', 'planning_ms_p50': '1.4', 'planning_ms_p99': '2.5',
}  # fmt: skip


def a_run(limit=100):
    return Run(NODES, wall_s=12.5, blocked=1, limit=limit)


@pytest.fixture
def played(recorder: Recorder, configuration):
    """Six segments: two touches on the way to the blocked way point, one lap."""
    points = configuration.scene.waypoints
    player = Player(recorder)
    player.go(points[0], duration=0.5)
    player.touch((0.06, -0.08))
    player.touch((0.06, -0.08), updated=False)
    player.go(points[1], offset=(0.0, 0.002))
    player.go(points[2])
    player.go(points[3])
    recorder.health(planner_health(**HEALTH))
    recorder.force(21.0)
    return recorder


def test_counts_of_a_known_run(played):
    trial = figures(played, a_run())
    assert trial['segments_executed'] == 6
    assert trial['contacts'] == 2
    assert trial['contact_segments'] == [2, 3]
    assert np.array(trial['contact_points_m']) == pytest.approx(
        np.array([(0.015, -0.04), (0.0375, -0.06)])
    )
    assert trial['contacts_last_100'] == 2
    assert trial['contacts_last_third'] == 0
    assert trial['updates_triggered'] == 1
    assert trial['laps'] == 1
    assert trial['waypoints_reached'] == 4
    assert trial['segments_to_blocked'] == [3]
    assert trial['nodes'] == list(NODES)
    assert trial['contact_force_peak_n'] == 21.0


def test_the_planner_is_quoted(played):
    trial = figures(played, a_run())
    assert trial['planning_ms'] == {'mean': 1.5, 'sd': 0.5, 'p50': 1.4, 'p99': 2.5}
    assert (trial['invalid_plans'], trial['deadline_misses']) == (0, 1)


def test_update_times_are_those_of_updates(played):
    # The synthetic lesson of segment n took 2 n ms, and only segment 2 was learned from.
    assert figures(played, a_run())['update_ms']['mean'] == 4.0


def test_execution_times_and_tracking_error_in_closed_form(played):
    trial = figures(played, a_run())
    assert trial['planned_execution_s']['mean'] == pytest.approx(5.5 / 6)
    # Of the four segments in free motion one was 2 mm off all along.
    assert trial['tracking_rmse_m'] == pytest.approx(0.002 / np.sqrt(4.0))


def test_length_is_that_of_the_executed_path(recorder):
    player = Player(recorder, at=(0.0, 0.0))
    player.go((0.1, 0.0))
    player.touch((0.1, 0.2))
    assert figures(recorder, a_run())['path_length_m'] == pytest.approx(0.2)


def test_segments_beyond_the_limit_do_not_count(played):
    trial = figures(played, a_run(limit=2))
    assert (trial['segments_executed'], trial['contacts'], trial['laps']) == (2, 1, 0)
    assert trial['contacts_last_third'] == 0


def test_a_run_without_segments_has_figures_too(recorder, configuration):
    report = document(configuration, recorder, a_run())
    trial = report['trials'][0]
    assert trial['segments_executed'] == trial['contacts'] == trial['laps'] == 0
    assert trial['tracking_rmse_m'] is None
    assert trial['planning_ms'] == dict.fromkeys(('mean', 'sd', 'p50', 'p99'))
    assert json.loads(json.dumps(report, allow_nan=False)) == report


def test_document_has_the_layout_of_an_experiment(played, configuration):
    report = document(configuration, played, a_run())
    assert json.loads(json.dumps(report, allow_nan=False)) == report
    assert {k: report[k] for k in ('scene', 'signal', 'alpha', 'segments', 'seed', 'world')} == {
        'scene': 'four_waypoints', 'signal': 'local', 'alpha': None, 'segments': 100,
        'seed': 0, 'world': 'mujoco',
    }  # fmt: skip
    (trial,) = report['trials']
    assert report['summary']['contacts'] == {'mean': trial['contacts'], 'sd': 0.0}
    assert report['summary']['planning_ms'] == {'mean': 1.5, 'sd': 0.0}
    assert 'seed' not in report['summary']


def test_closing_lines_tell_the_figures(played):
    text = '\n'.join(closing_lines(figures(played, a_run()), blocked=1))
    for words in ('6 segments', '2 touches', '1 update', '1 lap', 'after 3 segments', '21 N'):
        assert words in text


def test_closing_lines_of_nothing_are_no_error(recorder):
    text = '\n'.join(closing_lines(figures(recorder, a_run()), blocked=1))
    assert '0 segments' in text


@given(values=st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=50))
def test_spread_is_mean_deviation_and_percentiles(values):
    found = spread(values)
    assert found['mean'] == pytest.approx(np.mean(values))
    assert found['sd'] == pytest.approx(np.std(values), abs=1e-6)
    assert min(values) <= found['p50'] <= found['p99'] <= max(values)
    assert mean_sd(values) == {'mean': found['mean'], 'sd': found['sd']}
