# SPDX-License-Identifier: Apache-2.0
"""The launch file against stand-ins for `launch`, which no package index has."""

import argparse
import os
from pathlib import Path
import re
import runpy
import sys
from types import ModuleType, SimpleNamespace

import pytest
import yaml

from srnn_access import key_file
from srnn_bringup.config import Choices, load
from srnn_bringup.environment import graph_environment
from srnn_bringup.errors import ChoiceError
from srnn_bringup.graph import describe
from srnn_bringup.graph_options import add_up_options
from srnn_bringup.launch_arguments import launch_arguments, refuse_unknown
from srnn_bringup.record import RECORDING

ROOT = Path(__file__).parents[3]
PAGES = (ROOT / 'README.md', *sorted((ROOT / 'docs').glob('*.md')))
FILE = Path(__file__).parents[1] / 'launch' / 'srnn.launch.py'


class Recorded:
    """Keeps the arguments that it is made with."""

    def __init__(self, *positional, **named):
        self.positional = positional
        self.named = named

    def perform(self, context):
        return context[self.positional[0]]


class Context(dict):
    """The values of arguments, and what a launch file around this one has said."""

    def __init__(self, argv=(), around=None, **given):
        super().__init__({argument.name: argument.default for argument in launch_arguments()})
        self.update(given)
        self.argv = list(argv)
        self.launch_configurations = around or {}


@pytest.fixture
def launch_file(monkeypatch, tmp_path):
    stand_ins = {
        'launch': ('Action', 'LaunchContext', 'LaunchDescription'),
        'launch.actions': (
            'DeclareLaunchArgument', 'ExecuteProcess', 'OpaqueFunction', 'RegisterEventHandler',
        ),
        'launch.event_handlers': ('OnProcessIO',),
        'launch.events.process': ('ProcessIO',),
        'launch.substitutions': ('LaunchConfiguration',),
        'launch_ros': (),
        'launch_ros.actions': ('LifecycleNode', 'Node'),
    }  # fmt: skip
    for name, classes in stand_ins.items():
        module = ModuleType(name)
        for cls in classes:
            setattr(module, cls, type(cls, (Recorded,), {}))
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.setattr('tempfile.tempdir', str(tmp_path))
    return runpy.run_path(str(FILE))


def test_arguments_are_the_options_of_srnn_up_with_defaults_and_choices(launch_file):
    (entities,) = launch_file['generate_launch_description']().positional
    arguments = {entity.positional[0]: entity.named for entity in entities if entity.positional}
    parser = argparse.ArgumentParser(add_help=False)
    add_up_options(parser)
    assert list(arguments) == [action.dest for action in parser._actions]
    assert {'arm', 'scene', 'signal', 'record', 'view', 'namespace'} <= set(arguments)
    assert all(named['description'] for named in arguments.values())
    assert arguments['arm']['choices'] == ['sim', 'fri', 'mock']
    assert arguments['scene']['default_value'] == 'four_waypoints'
    assert 'four_waypoints' in arguments['scene']['description']
    assert arguments['emulator']['choices'] == ['false', 'true']
    assert arguments['signal']['choices'][0] == arguments['signal']['default_value'] == ''


@pytest.mark.parametrize(
    ('name', 'value', 'complaint'),
    [
        ('seed', 'x', "seed: 'x': must be a whole number from 0"),
        ('seed', '-1', "seed: '-1': must be a whole number from 0"),
        ('scene', 'disk', "did you mean 'disc'?"),
        ('save_weights', '/', "save_weights: '/': is a directory"),
        ('namespace', '1a', "namespace: '1a': must be a ROS namespace"),
        ('only', 'planer', "did you mean 'planner'?"),
        ('record', '/', "record: '/': is there already"),
    ],
)
def test_an_impossible_value_is_refused_by_name(launch_file, name, value, complaint):
    with pytest.raises(ChoiceError) as caught:
        launch_file['launch_processes'](Context(**{name: value}))
    assert complaint in str(caught.value)


def test_a_mistyped_name_is_refused_where_the_file_is_launched_itself(launch_file, monkeypatch):
    context = Context(argv=['emulater:=true'])
    monkeypatch.setattr('sys.argv', ['ros2', 'launch', 'others', 'two_arms.launch.py'])
    launch_file['check_names'](context)
    monkeypatch.setattr('sys.argv', ['ros2', 'launch', 'srnn_bringup', 'srnn.launch.py'])
    with pytest.raises(ChoiceError, match=r"'emulater' \(did you mean 'emulator'\?\)"):
        launch_file['check_names'](context)
    launch_file['check_names'](Context(argv=['arm:=mock', 'launch-prefix:=nice']))


@pytest.mark.parametrize('keyed', [True, False])
@pytest.mark.parametrize('only', [(), ('tracker', 'planner')])
def test_launched_nodes_are_those_of_the_graph(launch_file, tmp_path, keyed, only):
    key = str(tmp_path / 'graph.key') if keyed else ''
    if keyed:
        key_file.create(Path(key))
    context = Context(signal='global', seed='3', key=key, only=','.join(reversed(only)))
    launched = launch_file['launch_processes'](context)
    directory = Path(launched[0].named['parameters'][0]).parent
    whole = describe(load(Choices(signal='global', seed=3)), directory)
    expected = [node for node in whole if not only or node.name in only]
    assert [
        (n.named['name'], n.named['package'], n.named['executable']) for n in launched
    ] == [(n.name, n.package, n.executable) for n in expected]
    for node, description in zip(launched, expected, strict=True):
        assert node.named['respawn']
        assert node.named['respawn_delay'] > 0.0
        assert node.named['additional_env'] == graph_environment(os.environ)
        (path,) = node.named['parameters']
        (content,) = yaml.safe_load(Path(path).read_text()).values()
        assert content['ros__parameters'] == {
            **description.parameters, 'autostart': True, 'key_file': key,
        }


@pytest.mark.parametrize(('emulator', 'names'), [
    ('true', ['fri_emulator', 'fri_driver', 'tracker', 'adapter', 'planner']),
    ('false', ['fri_driver', 'tracker', 'adapter', 'planner']),
])  # fmt: skip
def test_the_real_arm_is_launched_with_or_without_its_controller(launch_file, emulator, names):
    context = Context(arm='fri', emulator=emulator, scene='disc')
    assert [node.named['name'] for node in launch_file['launch_processes'](context)] == names


@pytest.mark.parametrize(
    ('outer', 'inner', 'full'),
    [('', '/', '/'), ('', '/left', '/left'), ('/cell', '/', '/cell'), ('/cell', 'a', '/cell/a')],
)
def test_all_processes_are_in_the_namespace_and_follow_what_stands_around(
    launch_file, outer, inner, full
):
    around = {'ros_namespace': outer} if outer else {}
    around['ros_remaps'] = [('weights', '/others/weights')]
    context = Context(around=around, namespace=inner, view='8080')
    *nodes, view = launch_file['launch_processes'](context)
    assert {node.named['namespace'] for node in (*nodes, view)} == {full}
    assert all(node.named['remappings'] == around['ros_remaps'] for node in nodes)
    assert view.named['executable'] == 'view'


def test_nothing_is_started_before_it_can_be_recorded(launch_file, tmp_path):
    around = {'ros_remaps': [('weights', '/others/weights')]}
    context = Context(record=str(tmp_path / 'bag'), namespace='left', around=around)
    handler, recorder = launch_file['launch_processes'](context)
    command = recorder.named['cmd']
    rules = ['--remap', 'weights:=/others/weights']
    assert command[3:] == ['record', str(tmp_path / 'bag'), '--namespace', '/left', *rules]
    (told,) = handler.positional
    assert told.named['target_action'] is recorder
    start = told.named['on_stdout']
    assert start(SimpleNamespace(text=b'hello')) is None
    nodes = start(SimpleNamespace(text=f'{RECORDING} bag'.encode()))
    assert [node.named['name'] for node in nodes][-1] == 'planner'


@pytest.mark.parametrize('page', PAGES, ids=lambda page: page.name)
def test_the_documentation_names_arguments_that_there_are(page):
    for words in re.findall(r'srnn\.launch\.py((?: \w+:=\S+)+)', page.read_text()):
        refuse_unknown(word.partition(':=')[0] for word in words.split())
