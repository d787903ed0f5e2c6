# SPDX-License-Identifier: Apache-2.0
"""Everybody gets to the way point behind the obstacle, and paths are judged as they are."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from srnn_bench.clearance_map import OFF_CENTRE, ClearanceMap
from srnn_bench.grid_navigator import GridNavigator
from srnn_bench.known_navigator import KnownNavigator
from srnn_bench.mppi import MppiParameters
from srnn_bench.mppi_navigator import MppiNavigator
from srnn_bench.navigation_task import NO_PATH, navigation_task
from srnn_bench.path_quality import quality
from srnn_config.geometry import clearance
from srnn_config.scene import EDGE, load_scene
from srnn_planner.core.parameters import ModelParameters, PlanningParameters

SCENE = load_scene(Path(__file__).parents[3] / 'config' / 'scenes' / 'four_waypoints.yaml')
TASK = navigation_task(SCENE)
LEG = TASK.legs[TASK.blocked]


def network():
    return KnownNavigator(TASK, ModelParameters(), PlanningParameters())


def ompl(planner, simplify):
    pytest.importorskip('ompl')
    from srnn_bench.ompl_navigator import OmplNavigator

    return OmplNavigator(TASK, planner, simplify, 0)


@pytest.mark.parametrize(
    ('make', 'single'),
    [
        (network, False),
        (lambda: GridNavigator(TASK), True),
        (lambda: MppiNavigator(TASK, MppiParameters()), False),
        (lambda: ompl('RRTConnect', True), True),
        (lambda: ompl('RRTstar', False), True),
    ],
    ids=['known', 'a-star', 'mppi', 'rrt-connect', 'rrt-star'],
)
def test_the_way_point_behind_the_obstacle_is_reached_without_contact(make, single):
    attempt = make().run(TASK.blocked, 3)
    judged = quality(TASK, LEG, attempt.path)
    assert judged.reached
    assert judged.room > 0.0
    assert 0.997 < judged.ratio < 4.0
    assert min(attempt.seconds) > 0.0
    assert (len(attempt.seconds) == 1) is single


def test_the_straight_way_is_a_contact():
    assert np.linalg.norm(LEG.goal - LEG.start) - TASK.reach < LEG.shortest
    judged = quality(TASK, LEG, np.array([LEG.start, LEG.goal]))
    assert not judged.reached
    assert judged.room < 0.0


def test_a_path_counts_until_the_way_point_is_reached():
    free = replace(TASK, obstacles=())
    beyond = LEG.goal + 0.5 * (LEG.goal - LEG.start)
    judged = quality(free, LEG, np.array([LEG.start, beyond]))
    straight = np.linalg.norm(LEG.goal - LEG.start) - TASK.reach
    assert judged.reached
    assert judged.ratio * LEG.shortest == pytest.approx(straight, abs=0.0015)


@pytest.mark.parametrize('path', [NO_PATH, LEG.start[None], np.array([LEG.start, LEG.start])])
def test_who_does_not_move_does_not_arrive(path):
    assert not quality(TASK, LEG, path).reached


def test_the_map_is_right_up_to_half_a_cell():
    points = np.random.default_rng(0).uniform(-EDGE, EDGE, (500, 2))
    found = ClearanceMap(TASK.obstacles).at(points)
    assert np.abs(found - clearance(points, TASK.obstacles)).max() <= OFF_CENTRE
