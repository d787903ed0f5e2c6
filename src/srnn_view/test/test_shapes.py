# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from lwr_description import Kinematics, Mount
from srnn_config.scene import Obstacle
from srnn_view.shapes import SceneShapes

OBSTACLES = (
    Obstacle('box', center=(0.1, -0.05), size=(0.04, 0.12), yaw=np.pi / 2),
    Obstacle('disc', center=(-0.1, 0.1), radius=0.03),
    Obstacle('polygon', center=(0.0, 0.0), points=((0.0, 0.0), (0.1, 0.0), (0.0, 0.05))),
)


@pytest.fixture(scope='module')
def scene():
    return SceneShapes(Mount(), OBSTACLES)


def turned(orientation, vector):
    w, axis = orientation[0], np.array(orientation[1:])
    return vector + 2.0 * np.cross(axis, np.cross(axis, vector) + w * vector)


@pytest.mark.parametrize('seed', range(5))
def test_the_drawn_tool_ends_at_the_tip(scene, seed):
    mount = Mount()
    joints = np.random.default_rng(seed).uniform(-1.5, 1.5, 7)
    placed = {link: (position, turn) for link, position, turn in scene.place(joints)}
    position, turn = placed[scene.links.index('tool')]
    tip = np.array(position) + turned(turn, np.array([0.0, 0.0, mount.tool_length]))
    plane = [mount.plane_x, 0.0, mount.plane_z]
    np.testing.assert_allclose(tip - plane, Kinematics(mount).tip(joints), atol=1e-9)


def test_the_end_of_the_tool_is_round_and_around_the_tip(scene):
    mount = Mount()
    (tool,) = [shape for shape in scene.shapes if scene.links[shape.link] == 'tool']
    reach = tool.vertices[:, 2].max()
    assert reach == pytest.approx(mount.tool_length + mount.tool_radius, abs=1e-6)


@pytest.mark.parametrize(
    ('index', 'low', 'high'),
    [
        (0, (0.04, -0.07), (0.16, -0.03)),
        (1, (-0.13, 0.07), (-0.07, 0.13)),
        (2, (0.0, 0.0), (0.1, 0.05)),
    ],
)
def test_obstacles_are_where_the_scene_has_them(scene, index, low, high):
    mount = Mount()
    (post,) = [shape for shape in scene.shapes if shape.obstacle == index]
    assert post.link == 0
    outline = post.vertices[:, :2] - [mount.plane_x, 0.0]
    np.testing.assert_allclose(outline.min(axis=0), low, atol=2e-3)
    np.testing.assert_allclose(outline.max(axis=0), high, atol=2e-3)


def test_every_part_is_closed_and_has_another_name(scene):
    names = [shape.name for shape in scene.shapes]
    assert len(set(names)) == len(names)
    for shape in scene.shapes:
        edges = np.sort(shape.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        _, counts = np.unique(edges, axis=0, return_counts=True)
        assert (counts == 2).all(), shape.name
