# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from pathlib import Path
import shutil

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest
import yaml

from lwr_description import MissingModelError, ModelError
from srnn_bringup.config import Choices, load
from srnn_bringup.config_lookup import config_directory, find_scene, scene_names
from srnn_bringup.errors import BringupError, ChoiceError, ConfigDirectoryError
from srnn_config import ConfigError, ParameterError, UnknownKeyError
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import weights_file
from srnn_planner.core.errors import SrnnError
from srnn_planner.core.prior import PriorWeights
from srnn_planner.core.synapses import Synapses


@pytest.fixture
def directory(tmp_path):
    copy = tmp_path / 'config'
    shutil.copytree(config_directory(), copy)
    return copy


def edit(path: Path, change):
    data = yaml.safe_load(path.read_text())
    change(data)
    path.write_text(yaml.safe_dump(data))


def test_the_project_configures_itself():
    configuration = load(Choices())
    assert configuration.scene.task.name == 'four_waypoints'
    assert configuration.scene_path.is_absolute()
    assert configuration.learning.signal == 'local'
    assert configuration.alpha is None


def test_choices_win_over_files():
    chosen = load(Choices(signal='constant', alpha=0.2, seed=7))
    assert (chosen.learning.signal, chosen.learning.rate, chosen.alpha) == ('constant', 0.2, 0.2)
    assert chosen.seed == 7
    untouched = load(Choices())
    assert replace(chosen.learning, signal='local', rate=0.01) == untouched.learning
    assert chosen.network.planning == untouched.network.planning


@pytest.mark.parametrize(
    ('choices', 'error', 'words'),
    [
        (Choices(signal='locl'), ParameterError, 'one of none, global, local'),
        (Choices(alpha=0.1), ChoiceError, 'constant and untriggered'),
        (Choices(signal='constant', alpha=2.0), ParameterError, '> 0 and <= 1'),
        (Choices(seed=-1), ParameterError, 'seed = -1: must be >= 0'),
        (Choices(scene='four_waypoint'), ChoiceError, "did you mean 'four_waypoints'?"),
        (Choices(description='lwr4'), ChoiceError, "did you mean 'lwr4p'?"),
        (Choices(description='ur5e', arm='fri'), ParameterError, 'must be the LWR 4+'),
        (Choices(initial_weights=Path('nowhere.npz')), SrnnError, 'nowhere.npz'),
    ],
)
def test_impossible_choices_are_refused_by_name(choices, error, words):
    with pytest.raises(error) as caught:
        load(choices)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ('file', 'change', 'error', 'words'),
    [
        ('network.yaml', lambda d: d['model']['network'].update(sgma=0.1),
         UnknownKeyError, "did you mean 'sigma'?"),
        ('network.yaml', lambda d: d['planning']['sampling'].update(samples=0),
         ParameterError, 'samples = 0: must be >= 1'),
        ('network.yaml', lambda d: d['model']['network'].update(dimensions=3),
         ParameterError, 'dimensions = 3: must be 2'),
        ('arms/lwr4p.yaml', lambda d: d['mount'].update(tool_mass='heavy'),
         ParameterError, "tool_mass = 'heavy': must be a number"),
        ('arms/lwr4p.yaml', lambda d: d['mount']['description'].update(model='no_arms:a.xml'),
         MissingModelError, "mount.description.model = 'no_arms:a.xml': there is no Python "),
        ('arms/lwr4p.yaml', lambda d: d['mount']['description'].update(flange='hand'),
         ModelError, "mount.description.flange = 'hand': must be a body of "),
        ('arms/lwr4p.yaml', lambda d: d['arm']['impedance'].update(stiffness=[2000.0] * 6),
         ParameterError, 'must be 7 values, one for each joint'),
        ('tracking.yaml', lambda d: d['tracking']['gate'].update(speed_limit=0.05),
         ParameterError, 'velocity = 0.1: must be <= speed_limit = 0.05'),
        ('scenes/four_waypoints.yaml', lambda d: d.update(blocked=4),
         ParameterError, '0 to 3'),
    ],
)  # fmt: skip
def test_impossible_files_are_refused_by_name(directory, file, change, error, words):
    edit(directory / file, change)
    with pytest.raises(error) as caught:
        load(Choices(), directory)
    assert isinstance(caught.value, ConfigError)
    assert words in str(caught.value)


def test_missing_file_is_named(directory):
    (directory / 'tracking.yaml').unlink()
    with pytest.raises(ConfigError, match=r'tracking\.yaml'):
        load(Choices(), directory)


def test_keys_left_out_keep_their_default(directory):
    (directory / 'tracking.yaml').write_text('tracking: {}\n')
    assert load(Choices(), directory).tracking == load(Choices()).tracking


def test_learning_starts_from_given_weights_if_they_fit(tmp_path):
    path = tmp_path / 'weights.npz'
    prior = PriorWeights(load(Choices()).network.model.network)
    learned = Synapses.of(prior, np.full((225, 225), 0.25, dtype=np.float32)).learned
    weights_file.save(path, WeightsUpdate(3, 0, learned))
    assert load(Choices(initial_weights=path)).start_weights().learned.same_as(learned)
    for other, complaint in (
        (replace(learned, neurons=250), 'of 250 neurons: must be of 225'),
        (replace(learned, prior=0), 'beside the prior 0x00000000: must be'),
    ):
        weights_file.save(path, WeightsUpdate(3, 0, other))
        with pytest.raises(SrnnError, match=complaint):
            load(Choices(initial_weights=path))


def test_without_weights_learning_starts_from_the_prior(configuration):
    assert not len(configuration.start_weights().learned)


def test_scene_is_found_by_name_and_by_path(directory, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert scene_names(directory) == sorted(p.stem for p in (directory / 'scenes').iterdir())
    by_name = find_scene('four_waypoints', directory)
    assert find_scene(str(by_name), directory) == by_name
    shutil.copy(by_name, tmp_path / 'mine.yaml')
    assert find_scene('mine.yaml', directory) == tmp_path / 'mine.yaml'


@given(name=st.text(max_size=20))
def test_unknown_scenes_are_refused_with_the_names_there_are(name):
    directory = config_directory()
    if name in scene_names(directory) or (name and Path(name.replace('\0', '')).is_file()):
        return
    with pytest.raises(BringupError, match='four_waypoints'):
        find_scene(name.replace('\0', ''), directory)


def place(prefix: Path) -> Path:
    folder = prefix / 'share' / 'srnn_bringup' / 'config'
    folder.mkdir(parents=True)
    (folder / 'network.yaml').touch()
    return folder


def test_files_of_the_source_tree_go_before_installed_copies(monkeypatch, tmp_path):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    installed = place(tmp_path)
    # Where colcon tests what is installed, the module beside this test is not that of the import.
    here = config_directory(Path(__file__).parents[1] / 'srnn_bringup/config_lookup.py')
    assert here != installed
    assert (here.parent / 'src' / 'srnn_bringup').is_dir()
    assert config_directory(tmp_path / 'site-packages/srnn_bringup/config.py') == installed


def test_places_are_named_when_there_is_no_configuration(monkeypatch, tmp_path):
    monkeypatch.setenv('AMENT_PREFIX_PATH', '')
    monkeypatch.setattr('sys.prefix', str(tmp_path / 'empty'))
    with pytest.raises(ConfigDirectoryError) as caught:
        config_directory(tmp_path / 'site-packages/srnn_bringup/config.py')
    assert str(tmp_path / 'empty') in str(caught.value)
    assert isinstance(caught.value, FileNotFoundError)
