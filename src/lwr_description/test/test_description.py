# SPDX-License-Identifier: Apache-2.0
"""What a description says is what is built; what it cannot say is refused by name."""

from dataclasses import replace
from math import cos, sin

import mujoco
import numpy as np
from other_arms import LINK, mounted, slim
import pytest

from lwr_description import (
    MODELS,
    POSITION_MAX,
    TORQUE_MAX,
    VELOCITY_MAX,
    ArmDescription,
    Kinematics,
    MissingModelError,
    ModelError,
    Mount,
    UnreachableError,
    arm_spec,
)
from srnn_config import ParameterError

POSES = np.random.default_rng(8).uniform(-1.0, 1.0, (40, 7)) * POSITION_MAX


def chain(q):
    """Return the tip (3,) [m] of the slim arm by trigonometry."""
    reach = LINK * cos(q[1]) + (LINK + 0.05 + 0.1) * cos(q[1] + q[2])
    down = LINK * sin(q[1]) + (LINK + 0.05 + 0.1) * sin(q[1] + q[2])
    return np.array([reach * cos(q[0]), reach * sin(q[0]), 0.5 - down])


@pytest.fixture
def kinematics(tmp_path):
    return Kinematics(mounted(slim(tmp_path)))


def test_the_limits_of_the_lwr_are_those_of_its_description():
    limits = ArmDescription().limits
    np.testing.assert_array_equal(limits.position_max, POSITION_MAX)
    np.testing.assert_array_equal(limits.position_min, -POSITION_MAX)
    np.testing.assert_array_equal(limits.velocity_max, VELOCITY_MAX)
    np.testing.assert_array_equal(limits.torque_max, TORQUE_MAX)
    for array in limits:
        assert not array.flags.writeable


@pytest.mark.parametrize(
    ('file', 'flange'), [('lwr4p.xml', 'link7'), ('lwr4p.urdf', 'lwr_7_link')]
)
def test_the_lwr_from_a_file_of_a_user_is_the_one_built_in(file, flange):
    """Kinematics, gravity and inertia to 1e-9, from MJCF and from URDF."""
    built_in = Kinematics(Mount())
    description = ArmDescription(model=str(MODELS / file), flange=flange)
    described = Kinematics(Mount(description=description))
    # A URDF has no armature.
    armature = np.diag(built_in.mass_matrix(POSES[0]) - described.mass_matrix(POSES[0]))
    for q in POSES:
        np.testing.assert_allclose(described.tip(q), built_in.tip(q), rtol=0.0, atol=1e-9)
        np.testing.assert_allclose(
            described.jacobian(q), built_in.jacobian(q), rtol=0.0, atol=1e-9
        )
        np.testing.assert_allclose(described.gravity(q), built_in.gravity(q), rtol=0.0, atol=1e-9)
        np.testing.assert_allclose(
            described.mass_matrix(q) + np.diag(armature), built_in.mass_matrix(q),
            rtol=0.0, atol=1e-9,
        )  # fmt: skip


def test_a_urdf_needs_no_mesh(tmp_path):
    text = (MODELS / 'lwr4p.urdf').read_text()
    link = '<link name="lwr_7_link">'
    mesh = '<mesh filename="package://lwr/meshes/7.dae"/>'
    assert link in text
    path = tmp_path / 'meshes.urdf'
    path.write_text(
        text.replace(link, f'{link}<visual><geometry>{mesh}</geometry></visual>')
    )
    described = Mount(description=ArmDescription(model=str(path), flange='lwr_7_link'))
    np.testing.assert_allclose(
        Kinematics(described).tip(POSES[0]), Kinematics(Mount()).tip(POSES[0]), atol=1e-9
    )


def test_another_arm_is_where_trigonometry_puts_it(kinematics):
    limits = kinematics.limits
    for q in np.random.default_rng(1).uniform(limits.position_min, limits.position_max, (20, 4)):
        np.testing.assert_allclose(kinematics.tip(q), chain(q), rtol=0.0, atol=1e-12)
        step = 1e-6 * np.eye(4)
        slope = [(chain(q + d) - chain(q - d)) / 2e-6 for d in step]
        np.testing.assert_allclose(kinematics.jacobian(q), np.transpose(slope), atol=1e-8)


def test_the_inverse_keeps_to_limits_that_are_not_even(kinematics):
    limits = kinematics.limits
    for q in np.random.default_rng(2).uniform([-0.9, -1.5, 0.4, 0], [1.9, 0.4, 2.4, 0], (20, 4)):
        found = kinematics.inverse(chain(q), seed=q)
        np.testing.assert_allclose(chain(found), chain(q), atol=1e-6)
        assert (limits.position_min <= found).all()
        assert (found <= limits.position_max).all()
    with pytest.raises(UnreachableError):
        kinematics.inverse(chain([2.4, -0.8, 1.2, 0.0]))


def test_of_a_model_only_links_joints_and_shapes_are_kept(tmp_path):
    model = arm_spec(mounted(slim(tmp_path))).compile()
    assert [model.joint(i).name for i in range(model.njnt)] == ['pan', 'lift', 'elbow', 'wrist']
    assert [model.actuator(i).name for i in range(model.nu)] == ['pan', 'lift', 'elbow', 'wrist']
    np.testing.assert_array_equal(model.actuator_ctrlrange[:, 1], [50.0, 60.0, 70.0, 80.0])
    assert (model.nsensor, model.nkey) == (0, 0)
    touching = [model.geom(i).name for i in range(model.ngeom) if model.geom_contype[i]]
    assert touching == ['tool']
    assert not model.body_gravcomp.any()
    np.testing.assert_array_equal(model.opt.gravity, [0.0, 0.0, -9.80665])
    assert model.opt.integrator == mujoco.mjtIntegrator.mjINT_IMPLICITFAST


@pytest.mark.parametrize(
    ('changes', 'error', 'words'),
    [
        ({'joints': ('pan', 'elbow', 'lift', 'wrist')}, ModelError, 'in their order: pan, lift'),
        ({'joints': ('pan', 'lift', 'elbow', 'wirst')}, ModelError, 'wirst'),
        ({'joints': ('pan', 'lift', 'elbow', 'grip')}, ModelError, "'grip'"),
        ({'flange': 'hnad'}, ModelError, "flange = 'hnad': must be a body"),
        ({'model': 'slim.xml'}, MissingModelError, 'must be an absolute path or PACKAGE:PATH'),
        ({'model': 'no_arms:slim.xml'}, MissingModelError, "no Python package 'no_arms'"),
        ({'model': 'lwr_description:slim.xml'}, MissingModelError, 'there is no such file'),
    ],
)  # fmt: skip
def test_models_that_are_not_of_the_arm_are_refused_by_name(tmp_path, changes, error, words):
    with pytest.raises(error) as caught:
        arm_spec(mounted(slim(tmp_path, **changes)))
    assert words in str(caught.value)


def test_a_file_that_is_no_model_is_named(tmp_path):
    with pytest.raises(ModelError, match=r'slim\.xml'):
        arm_spec(mounted(slim(tmp_path, mjcf='<mujoco><nonsense/></mujoco>')))


@pytest.mark.parametrize(
    ('changes', 'words'),
    [
        ({'velocity_max': (1.0, 2.0, 3.0)}, 'velocity_max = (1.0, 2.0, 3.0): must be 4 values'),
        ({'torque_max': (1.0, 2.0, 3.0, 0.0)}, 'must be > 0'),
        ({'position_min': (3.0, -2.0, 0.2, -3.0)}, 'must be < position_max'),
        ({'joints': ('pan', 'pan', 'elbow', 'wrist')}, 'different names'),
        ({'joints': ('pan', 'lift')}, '3 or more'),
        ({'tool_axis': (0.0, 0.0, 0.0)}, 'not all zero'),
    ],
)
def test_impossible_descriptions_are_refused_by_name(tmp_path, changes, words):
    with pytest.raises(ParameterError) as caught:
        slim(tmp_path, **changes)
    assert words in str(caught.value)


def test_a_home_outside_the_limits_or_of_another_arm_is_refused(tmp_path):
    mount = mounted(slim(tmp_path))
    with pytest.raises(ParameterError, match='position_min'):
        replace(mount, home=(0.3, -0.8, 0.1, 0.1))
    with pytest.raises(ParameterError, match='4 values, one for each joint'):
        replace(mount, home=Mount().home)
