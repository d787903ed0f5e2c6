# SPDX-License-Identifier: Apache-2.0
import pytest
import yaml

from srnn_bringup.config_files import FILES, NetworkFile
from srnn_bringup.config_lookup import config_directory
from srnn_bringup.default_config import WIDTH, render, write
from srnn_config import build, read_yaml, to_mapping
from srnn_node.parameters import leaves


@pytest.mark.parametrize('name', FILES)
def test_files_of_the_project_state_every_key_with_its_default_and_meaning(name):
    """Else run ``python -m srnn_bringup.default_config config``."""
    assert (config_directory() / name).read_text(encoding='utf-8') == render(FILES[name]())


@pytest.mark.parametrize('name', FILES)
def test_what_is_written_reads_back_equal_with_equal_types(name, tmp_path):
    write(tmp_path)
    cls = FILES[name]
    data = read_yaml(tmp_path / name)
    assert data == to_mapping(cls())
    assert build(cls, data, name) == cls()
    assert yaml.safe_dump(data) == yaml.safe_dump(to_mapping(cls()))


@pytest.mark.parametrize('name', FILES)
def test_every_parameter_is_explained_with_its_unit(name):
    text = ' '.join(render(FILES[name]()).replace('#', ' ').split())
    for leaf in leaves(FILES[name]):
        assert ' '.join(leaf.spec.doc.split()) in text
        assert leaf.spec.unit in text


@pytest.mark.parametrize('name', FILES)
def test_no_line_is_too_long_to_read(name):
    assert max(map(len, render(FILES[name]()).splitlines())) <= WIDTH


def test_the_setting_of_the_paper_states_every_key_and_what_the_paper_states():
    data = read_yaml(config_directory() / 'network_paper.yaml')
    found = build(NetworkFile, data, 'network_paper.yaml')
    assert data == to_mapping(found)
    network, learning = found.model.network, found.model.learning
    assert (network.neurons_per_dimension, network.dimensions, network.tau) == (15, 2, 10)
    assert (learning.global_threshold, learning.local_threshold) == (0.02, 0.05)
    assert (learning.limit, learning.local_scale, learning.replays) == (0.3, 3.0, 20)
    assert found.planning.sampling.samples == 40


def test_the_network_of_three_dimensions_is_another_one_only_where_it_says_so():
    data = read_yaml(config_directory() / 'network_3d.yaml')
    assert data == to_mapping(build(NetworkFile, data, 'network_3d.yaml'))
    planar = to_mapping(NetworkFile())
    different = {
        (part, key)
        for part, values in data['model'].items()
        for key in values
        if values[key] != planar['model'][part][key]
    }
    assert data['planning'] == planar['planning']
    assert different == {
        ('network', 'dimensions'), ('network', 'sigma'), ('network', 'weight_offset'),
        ('network', 'spike_probability_max'), ('learning', 'rate_scale'),
    }  # fmt: skip
