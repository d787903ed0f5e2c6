# SPDX-License-Identifier: Apache-2.0
"""The transfer experiment: which worlds, whose weights, and what its trials mean."""

import csv
from dataclasses import replace
import io
from pathlib import Path

import numpy as np
import pytest

from srnn_config.scene import load_scene
from srnn_experiments.agent import Brain
from srnn_experiments.campaign import outcome_of
from srnn_experiments.errors import ExperimentError, SceneError
from srnn_experiments.setting import Setting
from srnn_experiments.transfer import Transfer, new_obstacles, transfers
from srnn_experiments.transfer_report import OVERALL, SOUND, Row, statistics, table
from srnn_experiments.transfer_text import as_csv, as_markdown
from srnn_experiments.transfer_trial import TargetTrial, target_trial
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

SCENES = Path(__file__).parents[3] / 'config/scenes'
SOURCE, TARGET = (load_scene(SCENES / f'{name}.yaml') for name in ('four_waypoints', 'transfer'))
BASE = Setting(SOURCE, Brain(ModelParameters(), PlanningParameters()), 20, 'point')
POINTS = Transfer('nothing', BASE, replace(BASE, scene=TARGET))
OLD, NEW = [0.072, -0.099], [0.055, 0.102]
"""Where a tool of 12 mm touches the first obstacle, and the new one."""


def figures(segments, points, **changes):
    plain = {
        'seed': 5, 'segments_executed': 20, 'contact_segments': segments,
        'contact_points_m': points, 'contacts_last_100': 0, 'still_reached': True,
        'updates_triggered': 2, 'laps': 3,
    }  # fmt: skip
    return {**plain, **changes}


def trial(seed=0, new=(), old=(), nothing=(), flaws=(), updates=0, laps=0):
    return TargetTrial(seed, tuple(new), tuple(old), tuple(nothing), flaws, updates, laps)


def test_the_target_scene_is_the_standard_one_and_an_obstacle_apart_from_the_first():
    (new,) = new_obstacles(SOURCE, TARGET)
    assert TARGET.obstacles == (*SOURCE.obstacles, new)
    assert (TARGET.waypoints, TARGET.start) == (SOURCE.waypoints, SOURCE.start)
    assert TARGET.task.blocked != SOURCE.task.blocked


def test_worlds_of_a_row_differ_in_what_it_says_and_in_nothing_else():
    rows = transfers(BASE, TARGET)
    assert list(rows) == ['point to arm', 'heavier arm', 'rougher joints', 'delayed commands']
    point, *others = rows.values()
    assert (point.source.world, point.target.arm) == ('point', BASE.arm)
    assert len({row.source.digest() for row in others}) == 1
    assert len({row.target.digest() for row in rows.values()}) == 4
    for row in rows.values():
        same = replace(row.target, scene=SOURCE, arm=BASE.arm, world=row.source.world)
        assert same.digest() == row.source.digest()
        assert row.target.world == 'mujoco'
        assert row.target.weights is None
    heavier, rougher, late = (row.target.arm for row in others)
    assert heavier.mismatch.mass_scale > BASE.arm.mismatch.mass_scale
    assert heavier.mismatch.payload > BASE.arm.mismatch.payload
    assert rougher.mismatch.friction == (1.0, 1.0, 1.0, 1.0, 0.5, 0.25, 0.25)
    assert late.command.delay > BASE.arm.command.delay
    assert '12 instead of 0 ms' in rows['delayed commands'].change


@pytest.mark.parametrize(
    ('source', 'target', 'words'),
    [
        (SOURCE, SOURCE, "'four_waypoints' must have an obstacle"),
        (TARGET, SOURCE, "'four_waypoints' lacks obstacle 3 of scene 'transfer'"),
    ],
)
def test_scenes_that_are_no_transfer_are_refused(source, target, words):
    with pytest.raises(SceneError, match=words) as caught:
        transfers(replace(BASE, scene=source), target)
    assert isinstance(caught.value, ExperimentError)
    assert isinstance(caught.value, ValueError)


def test_phase_two_starts_from_the_weights_of_phase_one_of_the_same_seed():
    (learner,) = POINTS.source_jobs([4])
    learned = outcome_of(learner)
    assert learned.figures['updates_triggered'] > 0
    (job,) = POINTS.target_jobs([4], [learned.synapses.learned])
    assert job.setting.weights is learned.synapses.learned
    (scratch,) = POINTS.scratch_jobs([4])
    assert job.key[0] != scratch.key[0]
    first, other = (outcome_of(j).records[0].plan.positions for j in (job, scratch))
    assert not np.array_equal(first, other)


def test_weights_that_were_learned_are_kept_where_nothing_is_new():
    """In a free world nothing is touched, and what is known stays bit for bit."""
    (learner,) = POINTS.source_jobs([4])
    learned = outcome_of(learner).synapses.learned
    free = replace(POINTS, target=replace(BASE, scene=replace(SOURCE, obstacles=())))
    (job,) = free.target_jobs([4], [learned])
    outcome = outcome_of(job)
    assert outcome.figures['contacts'] == outcome.figures['updates_triggered'] == 0
    assert outcome.synapses.learned.same_as(learned)


def test_every_seed_has_weights_of_its_own():
    with pytest.raises(ValueError, match='zip'):
        POINTS.target_jobs([1, 2], [np.zeros((225, 225), np.float32)])


def test_contacts_of_a_trial_are_told_apart():
    points = [NEW, OLD, [-0.2, -0.2], NEW]
    found = target_trial(figures([3, 4, 8, 9], points), POINTS)
    assert (found.new, found.old, found.nothing) == ((3, 9), (4,), (8,))
    assert (found.contacts, found.learned, found.few) == (4, True, True)
    assert found.failures == ('1 contact with the first one (segment 4)',)
    assert target_trial(figures([], []), POINTS).failures == ()


def test_all_contacts_of_real_trials_are_near_an_obstacle_and_none_is_lost():
    for job in (*POINTS.source_jobs([4]), *POINTS.scratch_jobs([4])):
        done = outcome_of(job).figures
        found = target_trial(done, POINTS)
        assert done['contacts'] > 0
        assert sorted(found.new + found.old) == done['contact_segments']
        assert not found.nothing


@pytest.mark.parametrize(('count', 'few'), [(7, True), (8, False)])
def test_few_contacts_are_those_of_the_paper(count, few):
    found = target_trial(figures(list(range(count)), [NEW] * count), POINTS)
    assert found.few == few
    assert found.failures == (() if few else ('8 contacts with the new obstacle',))


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        ({'contacts_last_100': 1}, '1 contact in the last 100 segments'),
        ({'still_reached': False}, 'not every way point reached in the last 100 segments'),
        ({'segments_executed': 19}, 'came to a halt after 19 segments'),
    ],
)
def test_a_flaw_is_named_and_means_that_nothing_was_learned(change, words):
    found = target_trial(figures([3], [NEW], **change), POINTS)
    assert found.failures == (words,)
    assert not found.learned
    assert not found.few


def test_statistics_of_a_row_are_those_of_its_trials():
    row = Row(
        transferred=[trial(0, new=(15, 16)), trial(1, new=(9,), old=(3,)), trial(2)],
        scratch=[trial(0, new=(1, 2), old=(3, 4)), trial(1, old=(1,)), trial(2, flaws=('x',))],
        source_learned=[True, False, True],
    )
    found = statistics(row)
    assert found['few']['share'] == 1.0
    assert found['old_untouched']['share'] == found['source_learned']['share'] == 2 / 3
    assert (found['new']['median'], found['new']['min'], found['new']['max']) == (1, 0, 2)
    assert (found['first_touch']['median'], found['first_touch']['max']) == (12, 15)
    assert found['scratch']['learned']['share'] == 2 / 3
    assert found['spared']['mean'] == pytest.approx((2 - 1 + 0) / 3)
    assert found['targets'] == {'few': True, 'median': True, 'old': False}
    assert statistics(Row([trial()], [trial()], [True]))['first_touch'] is None


@pytest.mark.parametrize(('failed', 'met'), [(1, True), (2, False)])
def test_nine_of_ten_trials_must_learn_with_few_contacts(failed, met):
    trials = [trial(seed, flaws=('halted',) * (seed < failed)) for seed in range(10)]
    row = Row(trials, trials, [True] * 10)
    assert statistics(row)['targets']['few'] is met
    assert table({'a': row, 'b': row})[OVERALL]['few']['share'] == 1 - failed / 10


def test_trials_are_counted_together_and_without_those_that_learned_nothing_before():
    trials = [trial(seed, new=[9] * seed) for seed in range(4)]
    some, none = [True, True, False, False], [False] * 4
    rows = {'a': Row(trials, trials, some), 'b': Row(trials, trials, none)}
    found = table(rows)
    assert list(found) == ['a', 'b', OVERALL, SOUND]
    assert (found[OVERALL]['trials'], found[OVERALL]['new']['total']) == (8, 12)
    assert (found[SOUND]['trials'], found[SOUND]['new']['total']) == (2, 1)
    assert SOUND not in table({'b': rows['b']})


def test_the_report_lists_failures_by_seed_and_the_paper():
    named = transfers(BASE, TARGET)
    row = Row(
        transferred=[trial(30, new=(15,)), trial(31, old=(7,), new=range(8))],
        scratch=[trial(30), trial(31)],
        source_learned=[True, False],
    )
    rows = dict.fromkeys(named, row)
    text = as_markdown(named, rows, table(rows), [30, 31], 'transfer.png')
    assert '# Transfer: 2 trials of 20 segments for each row' in text
    assert text.count('\n* heavier arm, seed 31: 8 contacts with the new obstacle; 1 contact') == 1
    assert 'seed 30:' not in text
    assert 'nor had phase 1 learned' in text
    assert '| paper, real arm, 1 trial | – | 7 | 0 | – | 15 |' in text
    assert '4 in 8 trials (missed)' in text
    widths = {line.count('|') for line in text.split('\n\n')[2].splitlines()}
    assert widths == {9}


def test_a_line_of_the_table_is_a_trial_with_or_without_transfer():
    done = trial(3, new=(15, 16), old=(4,), nothing=(9,), updates=5, laps=2)
    rows = {'a': Row([done], [trial(3, new=(2,), flaws=('x',))], [True])}
    lines = list(csv.DictReader(io.StringIO(as_csv(rows))))
    assert [line['start'] for line in lines] == ['transferred', 'scratch']
    assert lines[0] == {
        'row': 'a', 'start': 'transferred', 'seed': '3', 'learned': '1', 'contacts_new': '2',
        'contacts_old': '1', 'contacts_nothing': '1', 'first_touch': '15', 'updates': '5',
        'laps': '2',
    }  # fmt: skip
    assert (lines[1]['learned'], lines[1]['contacts_new']) == ('0', '1')
