# SPDX-License-Identifier: Apache-2.0
"""The simulated arm holds, follows, yields and reports as the joint impedance law demands."""

from math import pi

import numpy as np
import pytest

from lwr_description import Kinematics, Mount
from lwr_guard import Refusal
from lwr_sim_bridge import (
    ArmParameters,
    MismatchParameters,
    NoiseParameters,
    SimulatedArm,
    SimulationError,
)
from srnn_config.scene import build_scene

MOUNT = Mount()
KINEMATICS = Kinematics(MOUNT)
EXACT = ArmParameters(
    mismatch=MismatchParameters(mass_scale=1.0, payload=0.0, friction=(0.0,) * 7),
    noise=NoiseParameters(scale=0.0),
)


def arm_at(x=0.0, y=0.0, parameters=None, seed=0):
    """Return an arm at rest at (x, y), without obstacles, of the default parameters."""
    scene = build_scene({'name': 'free', 'waypoints': [[x, y]]}, 'test')
    return SimulatedArm(parameters or ArmParameters(), MOUNT, scene, np.random.default_rng(seed))


def run(arm, seconds):
    for _ in range(round(1000 * seconds)):
        arm.step()


def circle(t, radius=0.15, speed=0.1):
    """Return a point on a circle run at `speed` after a smooth start of one second."""
    run_up = min(t, 1.0)
    angle = speed / radius * (run_up**3 - run_up**4 / 2 + max(t - 1.0, 0.0))
    return np.array([radius * np.cos(angle), radius * np.sin(angle), 0.0])


def test_time_counts_ticks():
    arm = arm_at()
    run(arm, 0.25)
    assert arm.time == pytest.approx(0.25, abs=1e-12)


def test_without_commands_it_holds_its_start():
    arm = arm_at(0.1, -0.2)
    start = arm.tip_truth
    run(arm, 1.0)
    assert np.linalg.norm(arm.tip_truth - start) < 1e-3
    assert np.abs(arm.data.qvel).max() < 1e-4


def test_when_commands_cease_it_comes_to_rest_at_the_last_one():
    arm = arm_at(parameters=EXACT)
    for k in range(100):
        q = KINEMATICS.inverse([0.0004 * k, 0.0, 0.0])
        assert arm.command(q) is None
        run(arm, 0.004)
    run(arm, 0.5)
    np.testing.assert_allclose(arm.data.qpos, q, atol=1e-6)


def test_follows_a_smooth_path_ten_milliseconds_late_within_half_a_millimetre():
    arm = arm_at(0.15, 0.0)
    delay = 0.010
    run(arm, 0.3)
    errors = []
    q = None
    for tick in range(3000):
        if tick % 4 == 0:
            q = KINEMATICS.inverse(circle(tick / 1000), seed=q)
            assert arm.command(q) is None
        arm.step()
        errors.append(arm.tip_truth - circle(max((tick + 1) / 1000 - delay, 0.0)))
    assert np.sqrt(np.mean(np.sum(np.square(errors), axis=1))) < 5e-4


@pytest.mark.parametrize('force', [(8.0, 0.0, 0.0), (0.0, 8.0, 0.0), (3.0, -4.0, 6.0)])
def test_yields_to_a_force_as_its_stiffness_says(force):
    """Displacement at rest is J K^-1 J' F."""
    arm = arm_at(0.1, 0.1, parameters=EXACT)
    before = arm.tip_truth
    jacobian = KINEMATICS.jacobian(arm.data.qpos)
    arm.data.qfrc_applied = jacobian.T @ force
    run(arm, 1.0)
    compliance = jacobian / EXACT.impedance.stiffness @ jacobian.T
    expected = compliance @ force
    np.testing.assert_allclose(
        arm.tip_truth - before, expected, atol=0.02 * np.linalg.norm(expected)
    )


def test_a_push_dies_out():
    """With damping alone acting, what a push has brought in is gone after half a second."""
    arm = arm_at(parameters=EXACT)
    arm.data.qvel = 0.3 * np.array([1, -1, 1, -1, 1, -1, 1])
    run(arm, 0.5)
    assert np.abs(arm.data.qvel).max() < 1e-3


def test_estimates_an_applied_torque_with_the_stated_time_constant():
    arm = arm_at(parameters=EXACT)
    applied = np.array([0.0, 6.0, 0.0, -3.0, 0.0, 1.0, 0.0])
    arm.data.qfrc_applied = applied
    gain = EXACT.observer.gain
    for _ in range(50):
        run(arm, 0.002)
        estimate = arm.sample(0).external_torque
        expected = applied * (1 - np.exp(-gain * arm.time))
        np.testing.assert_allclose(estimate, expected, atol=0.35)
    run(arm, 0.5)
    np.testing.assert_allclose(arm.sample(0).external_torque, applied, atol=0.02)


def test_exact_model_in_free_motion_feels_nothing():
    arm = arm_at(0.15, 0.0, parameters=EXACT)
    largest = 0.0
    for k in range(500):
        arm.command(KINEMATICS.inverse(circle(0.004 * k, speed=0.2)))
        run(arm, 0.004)
        largest = max(largest, np.abs(arm.sample(0).external_torque).max())
    assert largest < 0.05


def test_default_mismatch_in_free_motion_stays_well_below_the_contact_threshold():
    arm = arm_at(0.15, 0.0, seed=2)
    forces = []
    for k in range(500):
        arm.command(KINEMATICS.inverse(circle(0.004 * k)))
        run(arm, 0.004)
        sample = arm.sample(0)
        jacobian = KINEMATICS.jacobian(sample.position)
        force = np.linalg.solve(jacobian @ jacobian.T, jacobian @ sample.external_torque)
        forces.append(np.hypot(force[0], force[1]))
    assert max(forces) < 5.0


def test_noise_has_the_stated_deviations():
    """Sample deviation of 7 x 300 values: within 10 % unless with probability < 1e-9."""
    arm = arm_at()
    run(arm, 0.01)
    samples = [arm.sample(0) for _ in range(300)]
    for name, deviation in (('position', 2e-5), ('velocity', 0.005), ('torque', 0.2)):
        values = np.array([getattr(sample, name) for sample in samples])
        spread = np.sqrt(np.mean((values - values.mean(axis=0)) ** 2))
        assert spread == pytest.approx(deviation, rel=0.1)


def test_sample_carries_its_stamp_and_is_not_overwritten():
    arm = arm_at()
    sample = arm.sample(123)
    kept = sample.position.copy(), sample.external_torque.copy()
    run(arm, 0.1)
    assert sample.stamp_ns == 123
    np.testing.assert_array_equal(sample.position, kept[0])
    np.testing.assert_array_equal(sample.external_torque, kept[1])


def recording(seed):
    arm = arm_at(0.15, 0.0, seed=seed)
    record = []
    for k in range(50):
        arm.command(KINEMATICS.inverse(circle(0.004 * k)))
        run(arm, 0.004)
        sample = arm.sample(k)
        fields = (sample.position, sample.velocity, sample.torque, sample.external_torque)
        record.append(np.concatenate((*fields, arm.data.qpos)))
    return np.array(record).tobytes()


def test_runs_of_one_seed_are_bit_identical_and_seeds_matter():
    assert recording(5) == recording(5)
    assert recording(5) != recording(6)


def test_a_refused_command_leaves_the_motion_as_it_was():
    told, clean = arm_at(), arm_at()
    bad = [np.full(7, np.nan), np.zeros(3), KINEMATICS.home + 0.3]
    reasons = [told.command(q) for q in bad]
    assert reasons == [Refusal.NOT_FINITE, Refusal.MALFORMED, Refusal.TOO_FAR]
    assert [told.refused[reason] for reason in reasons] == [1, 1, 1]
    run(told, 0.1)
    run(clean, 0.1)
    np.testing.assert_array_equal(told.data.qpos, clean.data.qpos)


@pytest.mark.parametrize('poison', [np.nan, np.inf])
def test_broken_physics_raises_instead_of_teleporting(poison, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo writes its warnings to the current directory.
    arm = arm_at()
    run(arm, 0.01)
    arm.data.qvel[0] = poison
    with pytest.raises(SimulationError, match=r'0\.011 s: .*BADQVEL'):
        run(arm, 0.1)


def test_start_of_the_scene_is_where_it_stands():
    angle = 2 * pi / 5
    arm = arm_at(0.2 * np.cos(angle), 0.2 * np.sin(angle))
    expected = [0.2 * np.cos(angle), 0.2 * np.sin(angle), 0.0]
    np.testing.assert_allclose(arm.tip_truth, expected, atol=1e-6)
