# SPDX-License-Identifier: Apache-2.0
"""The controller's own chain agrees with the MuJoCo model, joint by joint."""

import numpy as np
import pytest

from lwr_description import POSITION_MAX, Kinematics, Mount
from lwr_sim_bridge.fri.chain import Chain

UPRIGHT = Mount(base_height=0.0, pitch=0.0, plane_x=0.0, plane_z=0.0)
CHAIN = Chain(UPRIGHT.tool_length)
POSES = np.random.default_rng(3).uniform(-1.0, 1.0, (20, 7)) * POSITION_MAX


def pose_of(q):
    return CHAIN.poses_and_jacobians([q])[0][0]


def test_stretched_it_is_as_long_as_the_arm_with_its_tool():
    expected = np.column_stack((np.eye(3), [0.0, 0.0, 1.1785 + UPRIGHT.tool_length]))
    assert np.allclose(pose_of(np.zeros(7)), expected)


@pytest.mark.parametrize('joint', range(7))
def test_each_joint_alone_turns_the_tool_as_it_does_in_the_model(joint):
    kinematics = Kinematics(UPRIGHT)
    q = np.full(7, 0.3)
    q[joint] += 0.5
    assert np.allclose(pose_of(q)[:, 3], kinematics.tip(q), atol=1e-9)


def test_any_posture_has_the_tip_and_the_jacobian_of_the_model():
    kinematics = Kinematics(UPRIGHT)
    for q, pose, jacobian in zip(POSES, *CHAIN.poses_and_jacobians(POSES), strict=True):
        assert np.allclose(pose[:, 3], kinematics.tip(q), atol=1e-9)
        assert np.allclose(jacobian[:3], kinematics.jacobian(q), atol=1e-9)
        assert np.allclose(pose[:, :3] @ pose[:, :3].T, np.eye(3))


def test_rotations_are_those_of_finite_differences():
    for q, pose, jacobian in zip(POSES, *CHAIN.poses_and_jacobians(POSES), strict=True):
        for joint in range(7):
            step = np.eye(7)[joint] * 1e-6
            turned = (pose_of(q + step) - pose_of(q - step))[:, :3] / 2e-6
            spin = turned @ pose[:, :3].T
            found = [spin[2, 1], spin[0, 2], spin[1, 0]]
            assert np.allclose(found, jacobian[3:, joint], atol=1e-8)
