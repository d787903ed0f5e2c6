# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment transfer`: what it writes, remembers and refuses."""

import contextlib
import csv
from dataclasses import replace
import json

import pytest
from synthetic_run import Player
from test_picture import png_size

from srnn_bringup import cli
from srnn_bringup.config import Choices, load
from srnn_bringup.experiments.run import base_setting
from srnn_bringup.experiments.transfer import run_transfer
from srnn_bringup.picture import SIZE
from srnn_bringup.plots.style import DPI
from srnn_bringup.plots.transfer_picture import TransferStory, draw
from srnn_experiments import schedulers
from srnn_experiments.schedulers import LocalProcesses
from srnn_experiments.store import unpack
from srnn_experiments.transfer import Transfer

SEEDS = range(7, 9)
MEASURED = ('planning_ms', 'update_ms', 'wall_s')
WRITTEN = {'transfer.csv', 'transfer.json', 'transfer.md', 'transfer.png', 'trials.jsonl'}


@pytest.fixture(scope='module')
def rows():
    """Two rows that share their source, all in the point world."""
    source, target = (
        base_setting(load(Choices(scene=scene)), 12, 'point')
        for scene in ('four_waypoints', 'transfer')
    )
    shorter = replace(target, segments=8)
    return {'same': Transfer('nothing', source, target), 'less': Transfer('time', source, shorter)}


@pytest.fixture(scope='module')
def finished(rows, tmp_path_factory):
    """Return the directory of an uninterrupted run with one worker, and what it said."""
    directory, said = tmp_path_factory.mktemp('done'), []
    assert run_transfer(rows, SEEDS, LocalProcesses(1), directory, said.append) == 0
    return directory, said


def decisions(directory):
    """Return everything in the report that does not depend on the machine."""
    report = json.loads((directory / 'transfer.json').read_text())
    for starts in report['trials'].values():
        for trials in starts.values():
            for trial in trials:
                for name in MEASURED:
                    del trial[name]
    return report


def stored(directory):
    return [json.loads(line) for line in (directory / 'trials.jsonl').read_text().splitlines()]


def test_it_writes_report_table_picture_and_trials(finished):
    directory, said = finished
    assert {path.name for path in directory.iterdir()} == WRITTEN
    text = (directory / 'transfer.md').read_text()
    assert '\n'.join(said).startswith(text.partition('\n## ')[0])
    assert '](transfer.png)' in text
    assert png_size(directory / 'transfer.png') == (round(SIZE[0] * DPI), round(SIZE[1] * DPI))
    lines = list(csv.DictReader((directory / 'transfer.csv').open()))
    assert len(lines) == 2 * 2 * len(SEEDS)


def test_rows_with_the_same_source_share_phase_one(finished):
    trials = stored(finished[0])
    assert len(trials) == len(SEEDS) * (1 + 2 * 2)
    assert ['weights' in entry['trial'] for entry in trials] == [True] * 2 + [False] * 8
    report = decisions(finished[0])
    assert report['trials']['same']['source'] == report['trials']['less']['source']
    assert report['seeds'] == list(SEEDS)


def test_every_trial_of_phase_two_starts_from_the_weights_of_its_own_seed(rows, finished):
    entries = stored(finished[0])
    learned = {e['seed']: unpack(e['trial']['weights']) for e in entries[: len(SEEDS)]}
    done = {(entry['setting'], entry['seed']) for entry in entries}
    for transfer in rows.values():
        jobs = transfer.target_jobs(SEEDS, [learned[seed] for seed in SEEDS])
        assert {job.key for job in jobs} < done
        swapped = transfer.target_jobs(SEEDS, [learned[seed] for seed in reversed(SEEDS)])
        assert not {job.key for job in swapped} & done


def test_no_contact_is_lost_or_counted_twice(finished):
    for starts in decisions(finished[0])['trials'].values():
        for trial in (*starts['transferred'], *starts['scratch']):
            judged = trial['judged']
            told = judged['new'] + judged['old'] + judged['nothing']
            assert sorted(told) == trial['contact_segments']


def test_two_workers_find_what_one_finds(rows, finished, tmp_path):
    run_transfer(rows, SEEDS, LocalProcesses(2), tmp_path, lambda line: None)
    assert decisions(tmp_path) == decisions(finished[0])


@pytest.mark.parametrize('after', [1, 4])
def test_a_killed_run_goes_on_where_it_stopped(rows, finished, tmp_path, monkeypatch, after):
    real, done = schedulers.do, []

    def dies(job):
        if len(done) == after:
            raise KeyboardInterrupt
        done.append(job)
        return real(job)

    monkeypatch.setattr(schedulers, 'do', dies)
    with pytest.raises(KeyboardInterrupt):
        run_transfer(rows, SEEDS, LocalProcesses(1), tmp_path, lambda line: None)
    assert {path.name for path in tmp_path.iterdir()} == {'trials.jsonl'}
    monkeypatch.setattr(schedulers, 'do', lambda job: done.append(job) or real(job))
    run_transfer(rows, SEEDS, LocalProcesses(1), tmp_path, lambda line: None)
    assert decisions(tmp_path) == decisions(finished[0])
    assert len(done) == len(SEEDS) * (1 + 2 * 2)


@pytest.mark.parametrize(
    ('line', 'words'),
    [
        ('', '--out'),
        ('--out {} --target nowhere', "no scene 'nowhere'"),
        ('--out {} --target four_waypoints', "must have an obstacle that scene 'four_waypoints'"),
        ('--out {} --scene box', "'transfer' lacks obstacle 0 of scene 'box'"),
        ('--out {} --scene bxo', "did you mean 'box'?"),
        ('--out {} --network nett', "no network 'nett'"),
        ('--out {} --world point', "unknown argument '--world'"),
        ('--out {} --trials 0', 'must be a whole number from 1'),
        ('--out {} --taget transfer', "did you mean '--target'?"),
    ],
)
def test_a_mistyped_option_gives_one_clear_line(line, words, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr('srnn_bringup.experiments.transfer.run_transfer', not_reached)
    with contextlib.suppress(SystemExit):
        assert cli.main(['experiment', 'transfer', *line.format(tmp_path / 'out').split()]) == 2
    error = capsys.readouterr().err
    assert words in error
    assert len(error.splitlines()) == 1
    assert not (tmp_path / 'out').exists()


def not_reached(*_):
    raise AssertionError('started in spite of a mistake')


def test_options_reach_the_experiment(tmp_path, monkeypatch):
    calls = []
    monkeypatch.setattr(
        'srnn_bringup.experiments.transfer.run_transfer',
        lambda *arguments: calls.append(arguments) or 0,
    )
    line = f'--trials 3 --segments 9 --seed 5 --network network_paper --workers 1 --out {tmp_path}'
    assert cli.main(['experiment', 'transfer', *line.split()]) == 0
    ((rows, seeds, _, directory, say),) = calls
    assert (len(rows), list(seeds), directory, say) == (4, [5, 6, 7], tmp_path, print)
    paper = load(Choices(network='network_paper')).network
    for row in rows.values():
        assert (row.source.segments, row.target.segments) == (9, 9)
        assert row.source.brain == row.target.brain
        assert row.source.brain.model == paper.model
        assert row.target.scene.task.name == 'transfer'


def test_the_picture_goes_on_after_the_last_touch(recorder, configuration, tmp_path):
    player = Player(recorder)
    player.touch((0.1, -0.1))
    player.go((0.1, 0.1))
    player.touch((0.1, 0.0), updated=False)
    player.go((0.15, 0.15))
    scene = configuration.scene
    story = TransferStory('here', scene, scene.obstacles[:1], recorder.records)
    assert story.touched_until == 3
    draw(story, tmp_path / 'some.png')
    nothing = TransferStory('here', scene, scene.obstacles[:1], [])
    assert nothing.touched_until == 0
    draw(nothing, tmp_path / 'none.png')
    some, none = (tmp_path / name for name in ('some.png', 'none.png'))
    assert png_size(some) == png_size(none) == (round(SIZE[0] * DPI), round(SIZE[1] * DPI))
    assert some.stat().st_size > none.stat().st_size


@pytest.mark.slow
def test_from_a_point_to_the_arm_and_from_arm_to_arm(tmp_path):
    """The command itself: how well it does is for the report to say, not for a test."""
    line = f'--trials 1 --segments 120 --seed 3000 --out {tmp_path / "t"}'
    assert cli.main(['experiment', 'transfer', *line.split()]) == 0
    assert {path.name for path in (tmp_path / 't').iterdir()} == WRITTEN
    report = decisions(tmp_path / 't')
    assert set(report['rows']) == set(report['trials']) == {
        'point to arm', 'heavier arm', 'rougher joints', 'delayed commands',
    }  # fmt: skip
    sources = [starts['source'] for starts in report['trials'].values()]
    assert sources[0] != sources[1] == sources[2] == sources[3]
    for starts in report['trials'].values():
        (transferred,), (scratch,) = starts['transferred'], starts['scratch']
        assert transferred['path_length_m'] != scratch['path_length_m']
        for trial in (transferred, scratch):
            judged = trial['judged']
            assert trial['segments_executed'] == 120
            assert trial['contact_force_peak_n'] is not None
            assert sorted(judged['new'] + judged['old']) == trial['contact_segments']
        # Nobody told the network of the obstacles, so who has not learned must touch one.
        assert scratch['judged']['old'] + scratch['judged']['new']
