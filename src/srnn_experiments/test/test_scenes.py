# SPDX-License-Identifier: Apache-2.0
"""The scenes that come with the project, and those that a seed makes."""

from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_description import Mount
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.scene_model import SceneModel
from srnn_config.geometry import clearance
from srnn_config.scene import EDGE, Obstacle, Scene, SceneTask, load_scene
from srnn_experiments.random_scene import APART, is_solvable, random_scene

GALLERY = sorted((Path(__file__).parents[3] / 'config/scenes').glob('*.yaml'))


def beeline_clearance(scene: Scene) -> float:
    """Least clearance [m] on the straight way to the blocked way point."""
    goal = np.array(scene.waypoints[scene.task.blocked])
    start = np.array(scene.waypoints[scene.task.blocked - 1])
    return float(clearance(np.linspace(start, goal, 200), scene.obstacles).min())


def test_the_gallery_has_the_cases_that_people_ask_for():
    names = {path.stem for path in GALLERY}
    assert names >= {
        'four_waypoints', 'eight', 'box', 'disc', 'wall', 'corner', 'two_obstacles',
        'near_waypoint', 'appears', 'disappears',
    }  # fmt: skip


@pytest.mark.parametrize('path', GALLERY, ids=lambda path: path.stem)
def test_every_scene_is_named_solvable_and_blocks_the_way_it_says(path):
    scene = load_scene(path)
    assert scene.task.name == path.stem
    assert is_solvable(scene, room=0.02)
    assert beeline_clearance(scene) < Mount().tool_radius


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**31 - 1))
def test_random_scenes_are_solvable_and_block_the_way_they_say(seed):
    scene = random_scene(seed)
    assert is_solvable(scene)
    assert beeline_clearance(scene) < Mount().tool_radius
    points = np.array(scene.waypoints)
    assert np.abs(points).max() < EDGE
    assert np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).min() >= APART


def test_a_seed_makes_one_scene_and_the_simulator_can_build_it():
    assert random_scene(7) == random_scene(7)
    assert random_scene(7) != random_scene(8)
    for seed in range(12):
        SceneModel(Mount(), ArmParameters(), random_scene(seed).obstacles)


def test_a_wall_from_edge_to_edge_cannot_be_solved():
    wall = Obstacle('box', (0.0, 0.0), size=(0.02, 0.6))
    points = ((-0.15, 0.0), (0.15, 0.0))
    assert not is_solvable(Scene(SceneTask(name='walled'), points, (wall,), start=points[0]))
    covered = Obstacle('disc', (0.15, 0.0), radius=0.02)
    assert not is_solvable(Scene(SceneTask(name='on'), points, (covered,), start=points[0]))
