# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from srnn_access import key_file
from srnn_bringup import cli
from srnn_bringup.graph import access
from srnn_bringup.run_outputs import Outputs


@pytest.mark.parametrize(
    ('line', 'words'),
    [
        ('dmo', "'demo', 'up', 'pause', 'resume', 'record'"),
        ('demo --key /nowhere.key', 'key file /nowhere.key: there is no such file'),
        ('up --key /', 'key file /: must be a regular file'),
        ('up --ky /nowhere.key', "did you mean '--key'?"),
        ('key', 'ACTION'),
        ('key mend', "'create'"),
        ('key create', 'FILE'),
        ('key create a.key b.key', "unknown argument 'b.key'"),
        ('key create /nowhere/a.key', "no directory '/nowhere'"),
        ('', 'COMMAND'),
        ('demo --signl local', "did you mean '--signal'?"),
        ('demo --signal locl', "'none', 'global', 'local', 'constant', 'untriggered'"),
        ('demo --scene four_waypoint', "did you mean 'four_waypoints'?"),
        ('demo --scene /nowhere.yaml', 'four_waypoints'),
        ('demo --seed -1', 'a whole number from 0'),
        ('demo --seed x', 'a whole number from 0'),
        ('demo --segments 0', 'a whole number from 1'),
        ('demo --alpha 0 --signal constant', '> 0 and <= 1'),
        ('demo --alpha 0.1', 'constant and untriggered'),
        ('demo --weights /nowhere.npz', 'no such file'),
        ('demo --json /nowhere/demo.json', "no directory '/nowhere'"),
        ('demo --json /', 'is a directory'),
        ('demo --picture demo.txt', '.png, .pdf, .svg'),
        ('demo --arm mock', "choose from 'sim', 'fri'"),
        ('up --arm frii', "choose from 'sim', 'fri', 'mock'"),
        ('up --emulator', "arm 'sim' has no controller to emulate; it is for 'fri'"),
        ('demo now', "unknown argument 'now'"),
        ('up --segments 3', "unknown argument '--segments'"),
        ('up --only planer', "did you mean 'planner'?"),
        ('up --only planner,', "unknown node ''; nodes: sim_bridge, mock_arm, "),
        ('up --peer 300.1.2.3', 'must be an IPv4 or IPv6 address, or the name of a host'),
        ('pause --peer 127.0.0.1', 'is this host itself'),
        ('resume --only planner', "unknown argument '--only'"),
        ('up --namespace 1a', "'1a': must be a ROS namespace: words of letters"),
        ('up --namespace a__b', "'a__b': must be a ROS namespace"),
        ('up --remap weights', "'weights': must be FROM:=TO"),
        ('up --remap weights:=/a/weights,', "'weights:=/a/weights,': must be FROM:=TO"),
        ('pause --namespace a/', "'a/': must be a ROS namespace"),
        ('record', 'the following arguments are required: BAG'),
        ('record /', "'/': is there already; name a new directory"),
        ('demo --record /', "'/': is there already; name a new directory"),
        ('bench --only numpy,brain2', "unknown row 'brain2' (did you mean 'brian2-cpp'?); rows: "),
        ('bench --only numpy,brain2', 'rows: sampler, planner, numpy, '),
        ('bench --repeats 0', 'a whole number from 1'),
        ('bench --scene four_waypoint', "did you mean 'four_waypoints'?"),
        ('bench --out /nowhere/bench.md', "no directory '/nowhere'"),
        ('doctor --all', "unknown argument '--all'"),
        # A mistype of each kind, and the name that is nearest.
        ('dmo', "'dmo' (did you mean 'demo'?)"),
        ('belief lst run', "'lst' (did you mean 'list'?)"),
        ('experiment tabel1', "'tabel1' (did you mean 'table1'?)"),
        ('keystore crate', "'crate' (did you mean 'create'?)"),
        ('demo --signal locl', "'locl' (did you mean 'local'?)"),
        ('replay run --signal globl', "'globl' (did you mean 'global'?)"),
        ('experiment run --agent netwrk', "'netwrk' (did you mean 'network'?)"),
        ('experiment run --world mujco', "'mujco' (did you mean 'mujoco'?)"),
        ('up --arm frii', "'frii' (did you mean 'fri'?)"),
        ('completion bsh', "'bsh' (did you mean 'bash'?)"),
        ('bench --scene wal', "no scene 'wal' (did you mean 'wall'?)"),
        ('experiment transfer --target tranfer --out o', "(did you mean 'transfer'?)"),
        ('up --network netwrk', "no network 'netwrk' (did you mean 'network'?)"),
        ('replay run --set learning.replas=4', "'learning.replas' (did you mean 'learning.repl"),
        ('replay run --set lerning.limit=4', "'lerning.limit' (did you mean 'learning.limit'?)"),
        ('replay run --set limit', "'limit': must be KEY=VALUE"),
        # What is unknown is told of before what is missing.
        ('record --secur keystore', "unknown argument '--secur' (did you mean '--secure'?)"),
        ('experiment table1 --ot=d', "unknown argument '--ot=d' (did you mean '--out'?)"),
        ('belief diff run --pictur a.png', "unknown argument '--pictur' (did you mean"),
        ('doctor --json /nowhere/a.json', "no directory '/nowhere'"),
        ('up --arm-description ur5', "no arm description 'ur5' (did you mean 'ur5e'?)"),
        # An option that would change nothing.
        ('replay run --topic segment', '--topic segment has no effect without --publish'),
        ('replay run --rate 2', '--rate 2.0 has no effect without --publish'),
        ('replay run --seed 3', '--seed 3 has no effect without --scene'),
        ('replay run --publish --scene wall', '--scene wall has no effect with --publish'),
        (
            'replay run --publish --set learning.limit=4',
            '--set learning.limit=4 has no effect with --publish',
        ),
        (
            'experiment run --agent grid --save-weights a.npz',
            '--save-weights a.npz has no effect with --agent grid, which has no network',
        ),
        ('replay run --save-weights a.npz', '--save-weights needs --signal or --set'),
        ('replay run --signal global --save-weights /nowhere/a.npz', "no directory '/nowhere'"),
        ('belief list /nowhere@3', '/nowhere: there is no such bag or weight file'),
    ],
)
def test_mistakes_get_one_line_that_helps_and_exit_code_2(line, words, capsys, monkeypatch):
    monkeypatch.setattr('srnn_bringup.demo.run_demo', not_reached)
    monkeypatch.setattr('srnn_bringup.up.run_up', not_reached)
    try:
        code = cli.main(line.split())
    except SystemExit as end:
        code = end.code
    error = capsys.readouterr().err
    assert code == 2
    assert error.count('\n') == 1
    assert error.startswith('srnn')
    assert words in error


def not_reached(*_):
    raise AssertionError('started in spite of a mistake')


def test_weights_that_are_none_are_refused(tmp_path, capsys):
    path = tmp_path / 'weights.npz'
    path.write_text('no archive')
    assert cli.main(['demo', '--weights', str(path)]) == 2
    assert 'is no weight file' in capsys.readouterr().err
    np.savez(path, updates=np.zeros(3))
    assert cli.main(['demo', '--weights', str(path)]) == 2
    assert 'is no weight file: version: is missing' in capsys.readouterr().err


def test_scene_files_with_mistakes_are_refused(tmp_path, capsys):
    path = tmp_path / 'scene.yaml'
    path.write_text('name: mine\nwaypoints: [[0.0, 0.0]]\nvelocty: 0.1\n')
    assert cli.main(['demo', '--scene', str(path)]) == 2
    assert "did you mean 'velocity'?" in capsys.readouterr().err


@pytest.mark.parametrize(
    'command',
    [
        [], ['demo'], ['up'], ['pause'], ['resume'], ['record'], ['doctor'], ['bench'],
        ['key', 'create'], ['completion'],
    ],
)
def test_help_explains_every_option(command, capsys):
    with pytest.raises(SystemExit) as end:
        cli.main([*command, '--help'])
    assert end.value.code == 0
    text = capsys.readouterr().out
    assert text.startswith('usage: srnn')
    assert 'ROS_DOMAIN_ID' in text or not command or command[0] == 'key'


def test_options_reach_the_demo(tmp_path, monkeypatch):
    calls = []
    monkeypatch.setattr(
        'srnn_bringup.demo.run_demo', lambda *arguments: calls.append(arguments) or 0
    )
    figures, picture = tmp_path / 'd.json', tmp_path / 'd.svg'
    line = f'demo --signal global --segments 9 --seed 4 --json {figures} --picture {picture}'
    assert cli.main(line.split()) == 0
    ((configuration, segments, outputs, bag, view),) = calls
    assert (configuration.learning.signal, configuration.seed, segments) == ('global', 4, 9)
    assert outputs == Outputs(picture=picture, json=figures)
    assert bag is view is None


@pytest.mark.parametrize(
    ('line', 'port'), [('demo --view', 8080), ('demo --view 9000', 9000), ('up --view', 8080)]
)
def test_the_port_of_the_view_can_be_chosen(line, port, monkeypatch):
    calls = []
    for command in ('demo.run_demo', 'up.run_up'):
        monkeypatch.setattr(f'srnn_bringup.{command}', lambda *a: calls.append(a[-1]) or 0)
    assert cli.main(line.split()) == 0
    assert calls == [port]


def test_a_key_is_made_once_and_reaches_the_graph(tmp_path, monkeypatch, capsys):
    path = tmp_path / 'graph.key'
    assert cli.main(['key', 'create', str(path)]) == 0
    assert key_file.load(path).fingerprint in capsys.readouterr().out
    assert cli.main(['key', 'create', str(path)]) == 2
    assert 'never overwritten' in capsys.readouterr().err
    configurations = []
    monkeypatch.setattr('srnn_bringup.up.run_up', lambda c, *_: configurations.append(c) or 0)
    monkeypatch.chdir(tmp_path)
    assert cli.main(['up', '--key', 'graph.key']) == 0
    assert cli.main(['up']) == 0
    assert [access(c)['key_file'] for c in configurations] == [str(path), '']
    assert configurations[0].key().secret == key_file.load(path).secret
    assert configurations[1].key() is None
    path.chmod(0o640)
    assert cli.main(['up', '--key', 'graph.key']) == 2
    assert 'others than its owner may use it' in capsys.readouterr().err


def test_a_part_of_the_graph_starts_in_the_usual_order(monkeypatch):
    calls = []
    monkeypatch.setattr('srnn_bringup.up.run_up', lambda *arguments: calls.append(arguments) or 0)
    assert cli.main(['up']) == cli.main(['up', '--only', 'planner, tracker']) == 0
    assert [call[1:3] for call in calls] == [((), []), (('tracker', 'planner'), [])]


def test_exit_code_of_the_command_is_handed_on(monkeypatch):
    monkeypatch.setattr('srnn_bringup.up.run_up', lambda *arguments: 1)
    assert cli.main(['up']) == 1

