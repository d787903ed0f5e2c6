# SPDX-License-Identifier: Apache-2.0
"""The launch file against stand-ins for `launch`, which no package index has."""

from pathlib import Path
import runpy
import sys
from types import ModuleType

import pytest
import yaml

from srnn_access import key_file
from srnn_bringup.config import Choices, load
from srnn_bringup.graph import describe

FILE = Path(__file__).parents[1] / 'launch' / 'srnn.launch.py'


class Recorded:
    """Keeps the arguments that it is made with."""

    def __init__(self, *positional, **named):
        self.positional = positional
        self.named = named

    def perform(self, context):
        return context[self.positional[0]]


@pytest.fixture
def launch_file(monkeypatch, tmp_path):
    stand_ins = {
        'launch': ('LaunchContext', 'LaunchDescription'),
        'launch.actions': ('DeclareLaunchArgument', 'OpaqueFunction'),
        'launch.substitutions': ('LaunchConfiguration',),
        'launch_ros': (),
        'launch_ros.actions': ('LifecycleNode',),
    }
    for name, classes in stand_ins.items():
        module = ModuleType(name)
        for cls in classes:
            setattr(module, cls, type(cls, (Recorded,), {}))
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.setattr('tempfile.tempdir', str(tmp_path))
    return runpy.run_path(str(FILE))


def test_arguments_have_defaults_and_choices(launch_file):
    (entities,) = launch_file['generate_launch_description']().positional
    arguments = {entity.positional[0]: entity.named for entity in entities if entity.positional}
    assert set(arguments) == {'arm', 'emulator', 'scene', 'signal', 'seed', 'key', 'only'}
    assert arguments['arm']['choices'] == ['sim', 'fri', 'mock']
    assert arguments['scene']['default_value'] == 'four_waypoints'


@pytest.mark.parametrize('keyed', [True, False])
@pytest.mark.parametrize('only', [(), ('tracker', 'planner')])
def test_launched_nodes_are_those_of_the_graph(launch_file, tmp_path, keyed, only):
    key = str(tmp_path / 'graph.key') if keyed else ''
    if keyed:
        key_file.create(Path(key))
    context = {
        'arm': 'sim', 'scene': 'four_waypoints', 'signal': 'global', 'seed': '3', 'key': key,
        'only': ','.join(reversed(only)), 'emulator': 'false',
    }  # fmt: skip
    launched = launch_file['launch_nodes'](context)
    directory = Path(launched[0].named['parameters'][0]).parent
    whole = describe(load(Choices(signal='global', seed=3)), directory)
    expected = [node for node in whole if not only or node.name in only]
    assert [
        (n.named['name'], n.named['package'], n.named['executable']) for n in launched
    ] == [(n.name, n.package, n.executable) for n in expected]
    for node, description in zip(launched, expected, strict=True):
        assert node.named['respawn']
        assert node.named['respawn_delay'] > 0.0
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
    context = {
        'arm': 'fri', 'emulator': emulator, 'scene': 'disc', 'signal': '', 'seed': '0',
        'key': '', 'only': '',
    }  # fmt: skip
    assert [node.named['name'] for node in launch_file['launch_nodes'](context)] == names
