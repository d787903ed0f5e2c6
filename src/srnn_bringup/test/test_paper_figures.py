# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment figures`: what it writes, and that it is the same wherever it is done."""

import contextlib
from dataclasses import replace
import json

import numpy as np
import pytest

from srnn_bringup import cli
from srnn_bringup.config import Choices, load
from srnn_bringup.experiments.run import base_setting
from srnn_bringup.plots import style
from srnn_bringup.plots.paper_figures import FIGURES
from srnn_experiments import schedulers
from srnn_experiments.evaluation import collapse
from srnn_experiments.evaluation.trials import Evaluation, constant_rates, evaluation, jobs
from srnn_experiments.store import TrialStore

SEGMENTS, LONG, TRIALS, SEED = 10, 12, 2, 2000


def command(segments, long, trials, network):
    return (
        f'experiment figures --world point --segments {segments} --long {long} '
        f'--trials {trials} --seed {SEED} --network {network}'
    ).split()


LINE = command(SEGMENTS, LONG, TRIALS, 'network')
LONGER = command(150, 200, 3, 'network_paper')


def figures(folder, workers=1):
    assert cli.main([*LINE, '--workers', str(workers), '--out', str(folder)]) == 0
    return {name: (folder / f'{name}.json').read_text() for name in FIGURES}


def read(folder, line=LINE):
    """Return the evaluation whose trials lie in a folder."""
    asked = dict(zip(line[2::2], line[3::2], strict=True))
    configuration = load(Choices(network=asked['--network']))
    base = base_setting(configuration, int(asked['--segments']), asked['--world'])
    seeds = range(int(asked['--seed']), int(asked['--seed']) + int(asked['--trials']))
    store = TrialStore(folder / 'trials.jsonl')
    return evaluation(base, seeds, int(asked['--long']), lambda job: store[job.key])


@pytest.fixture(scope='module', autouse=True)
def small():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(style, 'DPI', 40)
        yield


@pytest.fixture
def undrawn(monkeypatch):
    numbers_alone = {
        name: replace(figure, draw=lambda *_: None) for name, figure in FIGURES.items()
    }
    monkeypatch.setattr('srnn_bringup.experiments.figures.FIGURES', numbers_alone)


@pytest.fixture(scope='module')
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp('figures') / 'out'
    figures(folder)
    return folder


def test_every_figure_comes_with_its_numbers_and_its_caption(folder):
    names = {f'{name}.{kind}' for name in FIGURES for kind in ('json', 'png')}
    assert {path.name for path in folder.iterdir()} == names | {'figures.md', 'trials.jsonl'}
    text = (folder / 'figures.md').read_text()
    for name in FIGURES:
        assert (folder / f'{name}.png').read_bytes()[:8] == b'\x89PNG\r\n\x1a\n'
        found = json.loads((folder / f'{name}.json').read_text())
        assert found['seeds'][0] == SEED
        assert f'![{name}]({name}.png)' in text
        assert FIGURES[name].content.headline(found) in text
        assert FIGURES[name].content.caption(found) in text
    assert 'paper 13.7 ± 1.4' in text


def test_a_figure_can_be_drawn_from_its_json_alone(folder, tmp_path):
    for name, figure in FIGURES.items():
        found = json.loads((folder / f'{name}.json').read_text())
        path = tmp_path / f'{name}.png'
        figure.draw(found, figure.content.headline(found), path)
        assert path.read_bytes() == (folder / path.name).read_bytes()


@pytest.mark.usefixtures('undrawn')
def test_many_workers_give_the_figures_that_one_gives(folder, tmp_path):
    expected = {name: (folder / f'{name}.json').read_text() for name in FIGURES}
    assert figures(tmp_path / 'two', workers=2) == expected


@pytest.mark.usefixtures('undrawn')
def test_what_was_done_is_not_done_again(folder, tmp_path, monkeypatch):
    lines = (folder / 'trials.jsonl').read_text().splitlines(keepends=True)
    assert len(lines) == TRIALS * (3 + len(constant_rates()))
    resumed = tmp_path / 'resumed'
    resumed.mkdir()
    (resumed / 'trials.jsonl').write_text(''.join(lines[:-3]))
    done = []
    real = schedulers.do
    monkeypatch.setattr(schedulers, 'do', lambda job: done.append(job) or real(job))
    found = figures(resumed)
    assert len(done) == 3
    assert found == {name: (folder / f'{name}.json').read_text() for name in FIGURES}


@pytest.mark.parametrize(
    ('line', 'words'),
    [
        ('experiment figures', '--out'),
        ('experiment figures --out o --long 0', 'must be a whole number from 1'),
        ('experiment figures --out o --lng 9', "did you mean '--long'?"),
        ('experiment figures --out o --network nett', "no network 'nett'"),
        ('experiment figures --out o --world moon', 'mujoco'),
        ('experiment figures --out /dev/null', 'is not a directory'),
    ],
)
def test_a_mistyped_option_is_refused_in_one_line(line, words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with contextlib.suppress(SystemExit):
        assert cli.main(line.split()) == 2
    error = capsys.readouterr().err
    assert words in error
    assert len(error.splitlines()) == 1
    assert not list(tmp_path.iterdir())


def cut(trial, segments):
    """Return a trial as if it had been given up after some segments."""
    trace = {name: values[:segments] for name, values in trial['trace'].items()}
    given_up = {'segments_executed': segments, 'still_reached': False, 'invalid_plans': 600}
    return {**trial, **given_up, 'trace': trace}


def test_a_collapse_is_reported_and_drawn(folder, tmp_path):
    done = read(folder)
    gone = {
        name: [cut(trials[0], 0), cut(trials[1], 7)] if name.startswith('untr') else trials
        for name, trials in done.trials.items()
    }
    found = collapse.numbers(Evaluation(done.base, done.seeds, done.long, gone))
    assert collapse.headline(found).startswith('Without a trigger 6 of 6 trials collapsed')
    assert collapse.caption(found).startswith('The model collapsed in 6 of 6')
    for name, setting in found['settings'].items():
        assert setting['states'].count('collapsed') == TRIALS * name.startswith('untr')
        known = [value is not None for value in setting['mean']['reached']]
        assert sum(known) == (7 if name.startswith('untr') else LONG)
    path = tmp_path / 'collapse.png'
    FIGURES['collapse'].draw(found, collapse.headline(found), path)
    assert path.stat().st_size > 0


def test_trials_in_which_nothing_was_learned_can_be_drawn(folder, tmp_path):
    done = read(folder)
    idle = [
        {**trial, 'paths': other['paths']}
        for trial, other in zip(done.trials['none'], [done.trials['local'][0]] * 2, strict=True)
    ]
    trials = {**done.trials, 'global': idle, 'local': idle}
    nothing = Evaluation(done.base, done.seeds, done.long, trials)
    for name in set(FIGURES) - {'collapse'}:
        figure = FIGURES[name]
        found = figure.content.numbers(nothing)
        figure.draw(found, figure.content.headline(found), tmp_path / f'{name}.png')
        assert figure.content.key_numbers(found)
    assert (
        'no signal exceeded'
        in FIGURES['signal_magnitudes'].content.key_numbers(
            FIGURES['signal_magnitudes'].content.numbers(nothing)
        )[0]
    )


def test_trials_in_which_nothing_could_be_planned_can_be_drawn(folder, tmp_path):
    done = read(folder)
    nowhere = {'times': [], 'plans': [], 'executed': []}
    trials = {
        name: [{**cut(trial, 0), 'paths': nowhere} for trial in trials]
        for name, trials in done.trials.items()
    }
    dead = Evaluation(done.base, done.seeds, done.long, trials)
    for name, figure in FIGURES.items():
        found = figure.content.numbers(dead)
        figure.draw(found, figure.content.headline(found), tmp_path / f'{name}.png')
        json.dumps(found, allow_nan=False)


def test_every_trial_leaves_what_the_figures_need():
    base = base_setting(load(Choices()), 9, 'point')
    todo = jobs(base, [5, 6], 11)
    assert {job.setting.segments for job in todo['untriggered 0.01']} == {11}
    assert {job.setting.segments for job in todo['local']} == {9}
    with_paths = [
        (name, job.seed) for name, group in todo.items() for job in group if 'paths' in job.keep
    ]
    assert with_paths == [('global', 5), ('local', 5)]


@pytest.mark.slow
def test_the_figures_of_longer_trials_obey_the_laws_of_the_method(tmp_path, capsys):
    assert cli.main([*LONGER, '--out', str(tmp_path)]) == 0
    assert 'Updates per trial' in capsys.readouterr().out
    found = {name: json.loads((tmp_path / f'{name}.json').read_text()) for name in FIGURES}
    done = read(tmp_path, LONGER)
    learning = done.base.brain.model.learning

    for name, signal in found['learning_signals']['signals'].items():
        assert signal['updates_touched'] == signal['updates_all'] > 0
        for peaks, updates in zip(signal['peaks'], signal['update_segments'], strict=True):
            above = np.flatnonzero(np.array(peaks) > signal['threshold']) + 1
            assert above.tolist() == updates, name

    visits = found['visits']['signals']
    for signal in visits.values():
        assert signal['begun'] - signal['cut_off'] == sum(map(len, signal['completed_at']))
        lengths = [n for v in signal['by_visit'] for n in v['completed'] + v['cut_off_after']]
        assert len(lengths) == signal['begun']
        assert sum(lengths) <= 3 * 150
        spent = signal['spent_per_visit']
        assert signal['low'] <= spent <= (signal['high'] or np.inf)
        assert spent * (signal['begun'] - signal['cut_off']) == pytest.approx(sum(lengths))
    reached = {name: signal['completed_per_trial']['mean'] for name, signal in visits.items()}
    assert reached['local'] > reached['none']
    assert visits['local']['spent_per_visit'] < visits['none']['spent_per_visit']

    for signal in found['signal_magnitudes']['signals'].values():
        assert sum(signal['counts']) == signal['count'] > 0
        assert signal['threshold'] <= signal['cut_of_largest'] <= learning.limit
        shares, masses = np.array(signal['curve']).T
        assert (masses >= shares - 1e-9).all()
        assert (np.diff(masses, 2) <= 1e-9).all()

    assert not np.any([trial['change']['input'] for trial in done.trials['none']])
    for name, (signal, _) in constant_rates().items():
        for trial in done.trials[name]:
            updated = trial['trace']['updated']
            above = np.array(trial['trace']['global_peak']) > learning.global_threshold
            assert all(updated) if signal == 'untriggered' else updated == above.tolist()
