# SPDX-License-Identifier: Apache-2.0
"""The model files hold the identified arm, in FRI order and signs, and agree with each other."""

import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import pytest

from lwr_description import (
    JOINT_NAMES,
    MODELS,
    POSITION_MAX,
    TIP_SITE,
    TORQUE_MAX,
    VELOCITY_MAX,
    Mount,
    arm_spec,
)

AXES = [(0, 0, 1), (0, -1, 0), (0, 0, 1), (0, 1, 0), (0, 0, 1), (0, -1, 0), (0, 0, 1)]


@pytest.fixture
def arm():
    """Return the tool-less upright arm."""
    return mujoco.MjModel.from_xml_path(str(MODELS / 'lwr4p.xml'))


@pytest.fixture
def urdf():
    """Return the root element of the URDF."""
    return ET.parse(MODELS / 'lwr4p.urdf').getroot()


def numbers(text):
    return np.array([float(word) for word in text.split()])


def stretched(arm):
    data = mujoco.MjData(arm)
    data.qpos[1] = np.pi / 2
    mujoco.mj_forward(arm, data)
    return data


def test_gravity_of_the_stretched_arm_is_the_identified_one(arm):
    gravity = np.abs(stretched(arm).qfrc_bias)
    assert gravity[1] == pytest.approx(47.25, abs=0.01)
    assert gravity[3] == pytest.approx(13.35, abs=0.01)


def test_rotor_free_mass_matrix_of_the_stretched_arm_is_the_identified_one(arm):
    arm.dof_armature[:] = 0.0
    mass = np.empty((7, 7))
    mujoco.mj_fullM(arm, stretched(arm), mass)
    expected = [2.799, 2.785, 0.0207, 0.4375, 0.0078, 0.0044, 0.00016]
    np.testing.assert_allclose(np.diag(mass), expected, rtol=0.01)


def test_moving_mass(arm):
    assert arm.body_subtreemass[arm.body('link1').id] == pytest.approx(14.2251)


def test_joints_actuators_and_limits_are_in_fri_order(arm):
    assert tuple(arm.joint(i).name for i in range(arm.njnt)) == JOINT_NAMES
    assert tuple(arm.actuator(i).name for i in range(arm.nu)) == JOINT_NAMES
    np.testing.assert_array_equal(arm.jnt_axis, AXES)
    np.testing.assert_allclose(arm.jnt_range, np.stack([-POSITION_MAX, POSITION_MAX], 1))
    np.testing.assert_array_equal(arm.actuator_ctrlrange, np.stack([-TORQUE_MAX, TORQUE_MAX], 1))


def test_limits_are_read_only():
    with pytest.raises(ValueError, match='read-only'):
        POSITION_MAX[0] = 1.0


def test_straight_arm_is_as_tall_as_the_data_sheet_says(arm):
    data = mujoco.MjData(arm)
    mujoco.mj_kinematics(arm, data)
    np.testing.assert_allclose(data.site('flange').xpos, [0, 0, 1.1785], atol=1e-12)


def test_urdf_joints_carry_the_limits(urdf):
    joints = urdf.findall('joint')
    assert tuple(joint.get('name') for joint in joints) == JOINT_NAMES
    for i, joint in enumerate(joints):
        limit = joint.find('limit')
        np.testing.assert_array_equal(numbers(joint.find('axis').get('xyz')), AXES[i])
        assert float(limit.get('upper')) == pytest.approx(POSITION_MAX[i])
        assert float(limit.get('lower')) == pytest.approx(-POSITION_MAX[i])
        assert float(limit.get('velocity')) == VELOCITY_MAX[i]
        assert float(limit.get('effort')) == TORQUE_MAX[i]


def test_urdf_forward_kinematics_equals_the_mjcf(arm, urdf):
    data = mujoco.MjData(arm)
    rng = np.random.default_rng(5)
    for q in rng.uniform(-POSITION_MAX, POSITION_MAX, (20, 7)):
        data.qpos = q
        mujoco.mj_kinematics(arm, data)
        position, rotation = urdf_flange(urdf, q)
        np.testing.assert_allclose(data.site('flange').xpos, position, atol=1e-12)
        np.testing.assert_allclose(data.site('flange').xmat.reshape(3, 3), rotation, atol=1e-12)


def urdf_flange(urdf, q):
    """Chain the joints of a URDF whose origins carry no rotation (Rodrigues' formula)."""
    position, rotation = np.zeros(3), np.eye(3)
    for joint, angle in zip(urdf.findall('joint'), q, strict=True):
        assert joint.find('origin').get('rpy') is None
        position = position + rotation @ numbers(joint.find('origin').get('xyz'))
        x, y, z = numbers(joint.find('axis').get('xyz'))
        skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        rotation = rotation @ (
            np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew
        )
    return position, rotation


def test_urdf_inertials_equal_the_mjcf(arm, urdf):
    for i, link in enumerate(urdf.findall('link')[1:], start=1):
        body = arm.body(f'link{i}')
        inertial = link.find('inertial')
        assert float(inertial.find('mass').get('value')) == pytest.approx(body.mass[0])
        np.testing.assert_allclose(numbers(inertial.find('origin').get('xyz')), body.ipos)
        terms = {key: float(value) for key, value in inertial.find('inertia').items()}
        tensor = np.array([
            [terms['ixx'], terms['ixy'], terms['ixz']],
            [terms['ixy'], terms['iyy'], terms['iyz']],
            [terms['ixz'], terms['iyz'], terms['izz']],
        ])
        np.testing.assert_allclose(
            np.linalg.eigvalsh(tensor), np.sort(body.inertia), rtol=1e-6, atol=1e-12
        )


def test_mounted_home_stands_over_the_middle_of_the_plane_with_the_tool_down():
    mount = Mount()
    model = arm_spec(mount).compile()
    data = mujoco.MjData(model)
    data.qpos = mount.home
    mujoco.mj_kinematics(model, data)
    np.testing.assert_allclose(data.site(TIP_SITE).xpos, [0.4005, 0.0, 0.251], atol=1e-4)
    tool_axis = data.site(TIP_SITE).xmat.reshape(3, 3)[:, 2]
    assert tool_axis[2] < -0.999


def test_mount_refuses_a_home_outside_the_limits():
    with pytest.raises(ValueError, match=r'Mount\.home'):
        Mount(home=(3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
