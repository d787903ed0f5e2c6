# SPDX-License-Identifier: Apache-2.0
"""Obstacles stand where the scene says, when it says, and only the tool can touch them."""

from math import pi, sqrt

import mujoco
import numpy as np
import pytest

from lwr_description import JOINT_NAMES, Kinematics, Mount
from lwr_sim_bridge import ArmParameters, ContactParameters, SceneShapeError
from lwr_sim_bridge.scene_model import SceneModel
from srnn_config.scene import Obstacle

MOUNT = Mount()
HOME = Kinematics(MOUNT).inverse([0.0, 0.0, 0.0])
RADIUS = MOUNT.tool_radius
PARAMETERS = ArmParameters()
TRIANGLE = ((-0.05, -0.03), (-0.05, 0.03), (-0.10, 0.0))


def scene_model(*obstacles, parameters=PARAMETERS):
    model = SceneModel(MOUNT, parameters, obstacles)
    model.place(HOME)
    return model


def clearance(model, index):
    geom = model.model.geom(f'obstacle_{index}').id
    return mujoco.mj_geomDistance(model.model, model.data, model.tool, geom, 1.0, None)


@pytest.mark.parametrize(
    ('obstacle', 'distance'),
    [
        (Obstacle('box', (0.10, 0.0), size=(0.10, 0.08)), 0.05),
        (Obstacle('box', (0.0, -0.10), size=(0.10, 0.08)), 0.06),
        (Obstacle('box', (0.10, 0.0), size=(0.02, 0.10), yaw=pi / 2), 0.05),
        (Obstacle('box', (0.10, 0.0), size=(0.06, 0.06), yaw=pi / 4), 0.10 - 0.03 * sqrt(2)),
        (Obstacle('disc', (0.0, 0.10), radius=0.04), 0.06),
        (Obstacle('polygon', (0.0, 0.0), points=TRIANGLE), 0.05),
        (Obstacle('polygon', (0.0, 0.0), points=TRIANGLE[::-1]), 0.05),
        (Obstacle('polygon', (0.02, 0.0), points=TRIANGLE, yaw=pi), 0.07),
    ],
)
def test_tool_at_the_origin_is_as_far_from_an_outline_as_geometry_says(obstacle, distance):
    assert clearance(scene_model(obstacle), 0) == pytest.approx(distance - RADIUS, abs=5e-4)


@pytest.mark.parametrize(
    'points',
    [
        ((0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.05, 0.02)),
        ((0.0, 0.0), (0.1, 0.1), (0.1, 0.0), (0.0, 0.1)),
        ((0.0, 0.0), (0.1, 0.1), (0.2, 0.2)),
        tuple((0.1 * np.cos(a), 0.1 * np.sin(a)) for a in 0.8 * pi * np.arange(5)),
    ],
    ids=['notched', 'crossed', 'flat', 'star'],
)
def test_polygons_that_are_not_convex_are_refused_by_name(points):
    with pytest.raises(SceneShapeError, match=r'obstacle_0: .*convex'):
        scene_model(Obstacle('polygon', (0.0, 0.0), points=points))


def test_obstacles_come_and_go_with_the_segments():
    first = Obstacle('disc', (0.1, 0.0), radius=0.02, disappears_at=3)
    second = Obstacle('disc', (-0.1, 0.0), radius=0.02, appears_at=2)
    model = scene_model(first, second)
    seen = []
    for segment in range(5):
        model.set_segment(segment)
        seen.append(model.present())
    assert seen == [(0,), (0,), (0, 1), (1,), (1,)]


def test_an_obstacle_waits_until_the_tool_has_left_its_place():
    model = scene_model(Obstacle('disc', (0.0, 0.0), radius=0.03))
    model.set_segment(0)
    assert model.present() == ()
    model.place(Kinematics(MOUNT).inverse([0.1, 0.0, 0.0]))
    model.settle()
    assert model.present() == (0,)


def test_an_obstacle_whose_time_is_over_does_not_come_late():
    model = scene_model(Obstacle('disc', (0.0, 0.0), radius=0.03, disappears_at=1))
    model.set_segment(0)
    model.set_segment(1)
    model.place(Kinematics(MOUNT).inverse([0.1, 0.0, 0.0]))
    model.settle()
    assert model.present() == ()


def test_only_the_tool_and_obstacles_that_are_there_collide():
    model = scene_model(Obstacle('disc', (0.1, 0.0), radius=0.02, appears_at=1))
    assert np.flatnonzero(model.model.geom_contype).tolist() == [model.tool]
    model.set_segment(1)
    touchable = {model.tool, model.model.geom('obstacle_0').id}
    assert set(np.flatnonzero(model.model.geom_contype)) == touchable


def test_plant_is_heavier_and_rubs_as_the_mismatch_says():
    plant = scene_model().model
    mismatch = PARAMETERS.mismatch
    tool = MOUNT.tool_mass + mismatch.payload
    moving = plant.body_subtreemass[plant.body('link1').id]
    assert moving == pytest.approx(14.2251 * mismatch.mass_scale + tool)
    rubbing = [plant.joint(name).frictionloss[0] for name in JOINT_NAMES]
    np.testing.assert_array_equal(rubbing, mismatch.friction)


def test_contact_parameters_reach_the_surface():
    contact = ContactParameters(time_constant=0.01, friction=0.7)
    obstacle = Obstacle('disc', (0.1, 0.0), radius=0.02)
    plant = scene_model(obstacle, parameters=ArmParameters(contact=contact)).model
    geom = plant.geom('obstacle_0')
    assert geom.solref[0] == 0.01
    assert geom.friction[0] == 0.7
