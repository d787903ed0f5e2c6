# SPDX-License-Identifier: Apache-2.0
from importlib import import_module
from pathlib import Path

import pytest
import yaml

from srnn_bringup.config import Choices, load
from srnn_bringup.errors import ChoiceError
from srnn_bringup.graph import BRAIN, NAMES, chosen, complete, describe, write_parameters
from srnn_config import build, to_mapping
from srnn_msgs_py.topics import NODES
from srnn_node.lifecycle import WorkspaceNode

GRAPHS = {
    'sim': Choices(seed=5),
    'mock': Choices(seed=5, arm='mock'),
    'fri': Choices(seed=5, arm='fri'),
    'fri emulated': Choices(seed=5, arm='fri', emulated=True),
}
BEFORE = {
    'sim': ('sim_bridge',), 'mock': ('mock_arm',), 'fri': ('fri_driver',),
    'fri emulated': ('fri_emulator', 'fri_driver'),
}  # fmt: skip


@pytest.fixture(scope='module')
def graphs():
    return {
        name: {node.name: node for node in describe(load(choices))}
        for name, choices in GRAPHS.items()
    }


@pytest.fixture(scope='module')
def nodes(graphs):
    return graphs['fri emulated'] | graphs['mock'] | graphs['sim']


@pytest.mark.parametrize('name', GRAPHS)
def test_the_arm_comes_up_first_and_the_planner_last(graphs, name):
    assert tuple(graphs[name]) == (*BEFORE[name], *BRAIN)
    assert [node for node in NAMES if node in graphs[name]] == list(graphs[name])


def test_the_table_of_topics_knows_every_node():
    assert set(NAMES) == set(NODES)


@pytest.mark.parametrize('name', GRAPHS)
def test_a_graph_is_complete_with_any_arm(graphs, name):
    seen = list(graphs[name])
    assert complete(seen)
    assert not complete(seen[:-1])
    assert not complete(BRAIN)


def test_a_node_of_another_arm_cannot_be_chosen():
    configuration = load(Choices())
    assert [node.name for node in chosen(configuration, ('planner', 'sim_bridge'))] == [
        'sim_bridge', 'planner',
    ]  # fmt: skip
    with pytest.raises(ChoiceError) as caught:
        chosen(configuration, ('fri_driver',))
    assert str(caught.value) == (
        "'fri_driver' is no node of arm 'sim'; nodes: sim_bridge, tracker, adapter, planner"
    )


def test_over_fri_the_tracker_keeps_the_pace_of_the_controller(graphs):
    for name in ('fri', 'fri emulated'):
        tracker, driver = graphs[name]['tracker'], graphs[name]['fri_driver']
        link = driver.parameters['fri']['link']
        assert tracker.parameters['tracking']['period'] == link['cycle']
        assert tracker.parameters['tracking']['limits']['max_step'] >= 2 * link['cycle']
    assert graphs['sim']['tracker'].parameters['tracking']['period'] == 0.004


def test_an_emulated_controller_and_its_driver_meet_and_meet_nobody_else(graphs):
    nodes = graphs['fri emulated']
    emulator, driver = (nodes[name].parameters for name in ('fri_emulator', 'fri_driver'))
    assert emulator['port'] == driver['fri']['link']['port'] != 49938
    assert emulator['driver'] == driver['fri']['link']['controller'] == '127.0.0.1'
    assert graphs['fri']['fri_driver'].parameters['fri']['link']['port'] == 49938


def test_only_a_controller_can_be_emulated():
    with pytest.raises(ChoiceError, match="arm 'mock' has no controller to emulate"):
        load(Choices(arm='mock', emulated=True))


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
        and member.__module__ == module
    ]
    return node_class.PARAMETERS


def types(value):
    if isinstance(value, dict):
        return {key: types(inner) for key, inner in value.items()}
    return [type(item) for item in value] if isinstance(value, list) else type(value)
