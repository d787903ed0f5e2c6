# SPDX-License-Identifier: Apache-2.0
"""Truth and estimate of contact: a wall pushes back as hard as the arm pushes."""

from dataclasses import replace

import numpy as np
import pytest

from lwr_description import Kinematics, Mount
from lwr_sim_bridge import (
    ArmParameters,
    ContactParameters,
    MismatchParameters,
    NoiseParameters,
    ObserverParameters,
    SimulatedArm,
)
from srnn_config.scene import build_scene

MOUNT = Mount()
KINEMATICS = Kinematics(MOUNT)
FACE = 0.10
EXACT = ArmParameters(
    mismatch=MismatchParameters(mass_scale=1.0, payload=0.0, friction=(0.0,) * 7),
    noise=NoiseParameters(scale=0.0),
    contact=ContactParameters(friction=0.0),
)
WALL = {'shape': 'box', 'center': [FACE + 0.05, 0.0], 'size': [0.1, 0.3]}
STEPS = {'appears_at': 1, 'disappears_at': 2}


def arm_before(wall, parameters=EXACT):
    """Return an arm at the origin and a wall with its face at x = FACE."""
    scene = build_scene({'name': 'wall', 'waypoints': [[0, 0]], 'obstacles': [wall]}, 'test')
    return SimulatedArm(parameters, MOUNT, scene, np.random.default_rng(0))


def advance(arm, start, end, speed=0.1, rest=0.0):
    """Command the tip along x from `start` to `end` at `speed`, then wait."""
    for x in np.linspace(start, end, round(abs(end - start) / (0.004 * speed))):
        assert arm.command(KINEMATICS.inverse([x, 0.0, 0.0])) is None
        for _ in range(4):
            arm.step()
    for _ in range(round(1000 * rest)):
        arm.step()


@pytest.fixture(scope='module')
def pressing():
    """Return an arm at rest, commanded 5 mm into the wall."""
    arm = arm_before(WALL)
    advance(arm, 0.0, FACE - MOUNT.tool_radius + 0.005, rest=1.0)
    return arm


def estimate(arm):
    jacobian = KINEMATICS.jacobian(arm.data.qpos)
    torque = arm.sample(0).external_torque
    return np.linalg.solve(jacobian @ jacobian.T, jacobian @ torque)


def test_there_is_no_force_in_free_motion():
    arm = arm_before(WALL)
    advance(arm, 0.0, 0.05)
    np.testing.assert_array_equal(arm.truth.raw, np.zeros(3))
    assert arm.truth.peak == 0.0


def test_wall_stops_the_tip_at_its_face(pressing):
    reach = pressing.tip_truth[0] + MOUNT.tool_radius
    assert reach == pytest.approx(FACE, abs=1e-3)


def test_wall_pushes_the_tool_away(pressing):
    force = pressing.truth.raw
    assert force[0] < -5.0
    np.testing.assert_allclose(force[1:], 0.0, atol=0.2 * abs(force[0]))


def test_force_grows_with_the_stiffness_along_the_normal(pressing):
    """A frictionless wall leaves the tip free sideways: F = depth / (J K^-1 J')_xx."""
    jacobian = KINEMATICS.jacobian(pressing.data.qpos)
    compliance = (jacobian / EXACT.impedance.stiffness @ jacobian.T)[0, 0]
    depth = FACE - MOUNT.tool_radius + 0.005 - pressing.tip_truth[0]
    assert -pressing.truth.raw[0] == pytest.approx(depth / compliance, rel=0.05)


def test_force_at_rest_balances_the_joint_springs(pressing):
    """J' F + K (q_d - q) = 0 where the joints stand; F from the simulator's truth."""
    q = pressing.data.qpos
    spring = pressing.sample(0).torque - KINEMATICS.gravity(q)
    pushed = KINEMATICS.jacobian(q).T @ pressing.truth.raw
    np.testing.assert_allclose(pushed, -spring, atol=0.02 * np.abs(spring).max())


def test_low_pass_at_rest_is_the_raw_force(pressing):
    np.testing.assert_allclose(pressing.truth.low_pass, pressing.truth.raw, atol=0.05)


def test_estimate_at_rest_is_the_true_force(pressing):
    np.testing.assert_allclose(estimate(pressing), pressing.truth.raw, atol=0.3)


def test_estimate_comes_from_the_observer_not_from_the_simulator():
    """An observer that is all but switched off feels nothing, however hard the wall pushes."""
    deaf = replace(EXACT, observer=ObserverParameters(gain=1e-6))
    arm = arm_before(WALL, deaf)
    advance(arm, 0.0, FACE, rest=0.2)
    assert np.linalg.norm(arm.truth.low_pass) > 8.0
    assert np.abs(arm.sample(0).external_torque).max() < 1e-3


def test_peak_is_the_largest_low_passed_force_since_it_was_cleared():
    arm = arm_before(WALL)
    advance(arm, 0.0, FACE - MOUNT.tool_radius + 0.004, rest=0.5)
    settled = np.linalg.norm(arm.truth.low_pass)
    assert arm.truth.peak >= settled
    arm.clear_peak()
    arm.step()
    assert arm.truth.peak == pytest.approx(settled, abs=0.1)


def test_softer_walls_hit_less_hard():
    peaks = []
    for time_constant in (0.002, 0.02):
        contact = ContactParameters(time_constant=time_constant, friction=0.0)
        arm = arm_before(WALL, replace(EXACT, contact=contact))
        advance(arm, 0.0, FACE - MOUNT.tool_radius + 0.002, speed=0.2)
        peaks.append(arm.truth.peak)
    assert peaks[0] > peaks[1] > 0.0


def test_wall_blocks_only_while_it_is_there():
    arm = arm_before(WALL | STEPS)
    inside = FACE + 0.02
    advance(arm, 0.0, inside, rest=0.1)
    assert arm.tip_truth[0] == pytest.approx(inside, abs=1e-3)
    advance(arm, inside, 0.0)
    arm.set_segment(1)
    assert arm.obstacles_present == (0,)
    advance(arm, 0.0, FACE, rest=0.1)
    assert arm.tip_truth[0] < FACE - MOUNT.tool_radius + 1e-3
    assert np.linalg.norm(arm.truth.raw) > 5.0
    arm.set_segment(2)
    assert arm.obstacles_present == ()
    for _ in range(300):
        arm.step()
    assert arm.tip_truth[0] == pytest.approx(FACE, abs=1e-3)
    np.testing.assert_allclose(arm.truth.low_pass, 0.0, atol=1e-6)
