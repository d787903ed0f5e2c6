# SPDX-License-Identifier: Apache-2.0
from importlib import import_module
from pathlib import Path

import pytest
import yaml

from srnn_bringup.config import Choices, load
from srnn_bringup.graph import NAMES, describe, write_parameters
from srnn_config import build, to_mapping
from srnn_msgs_py.topics import NODES
from srnn_node.lifecycle import WorkspaceNode


@pytest.fixture(scope='module')
def nodes():
    return {node.name: node for node in describe(load(Choices(seed=5)))}


def test_the_arm_comes_up_first_and_the_planner_last(nodes):
    assert tuple(nodes) == NAMES
    assert set(nodes) == set(NODES)
    first, *_, last = nodes
    assert (first, last) == ('sim_bridge', 'planner')


@pytest.mark.parametrize('name', NODES)
def test_every_node_gets_exactly_the_parameters_that_it_declares(nodes, name):
    node = nodes[name]
    cls = parameter_class(node.module)
    assert to_mapping(build(cls, node.parameters, name)) == node.parameters


@pytest.mark.parametrize('name', NODES)
def test_parameter_files_hold_the_parameters_with_their_types(nodes, name, tmp_path):
    path = write_parameters([nodes[name]], tmp_path, autostart=True)[name]
    (given,) = yaml.safe_load(path.read_text()).values()
    written = given['ros__parameters']
    assert written.pop('autostart') is True
    assert written == nodes[name].parameters
    assert types(written) == types(nodes[name].parameters)


def test_shared_parameters_are_the_same_for_all_who_share_them(nodes):
    assert nodes['planner'].parameters['model'] == nodes['adapter'].parameters['model']
    assert nodes['tracker'].parameters['mount'] == nodes['sim_bridge'].parameters['mount']
    assert {node.parameters.get('seed', 5) for node in nodes.values()} == {5}


def test_paths_are_absolute_or_empty(nodes, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    adapter = {n.name: n for n in describe(load(Choices(weights_file=Path('w.npz'))))}['adapter']
    assert adapter.parameters['weights_file'] == str(tmp_path / 'w.npz')
    assert adapter.parameters['initial_weights'] == ''


def parameter_class(module):
    members = vars(import_module(module)).values()
    (node_class,) = [
        member
        for member in members
        if isinstance(member, type)
        and issubclass(member, WorkspaceNode)
        and member is not WorkspaceNode
    ]
    return node_class.PARAMETERS


def types(value):
    if isinstance(value, dict):
        return {key: types(inner) for key, inner in value.items()}
    return [type(item) for item in value] if isinstance(value, list) else type(value)
