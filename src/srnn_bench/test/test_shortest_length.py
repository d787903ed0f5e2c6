# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from srnn_bench.errors import BenchError, TaskError
from srnn_bench.navigation_task import navigation_task
from srnn_bench.shortest_length import ShortestLength
from srnn_config.scene import Obstacle, build_scene

LEFT, RIGHT = np.array([-0.2, 0.0]), np.array([0.2, 0.0])


def test_without_an_obstacle_the_way_is_straight():
    assert ShortestLength((), 0.01).to_disc(LEFT, RIGHT, 0.06) == pytest.approx(0.34)


def test_a_disc_is_rounded_on_two_tangents_and_an_arc():
    distance, around = 0.01, 0.05
    lengths = ShortestLength([Obstacle('disc', (0.0, 0.0), radius=around - distance)], distance)
    tangent = np.sqrt(0.2**2 - around**2)
    exact = 2.0 * tangent + around * (np.pi - 2.0 * np.arccos(around / 0.2))
    found = lengths.to_disc(LEFT, RIGHT, 1e-6)
    assert exact * 0.9999 < found < exact * 1.003


def test_a_wall_is_rounded_at_its_nearer_end():
    wall = Obstacle('box', (0.0, -0.05), size=(0.002, 0.2))
    found = ShortestLength([wall], 0.001).to_disc(LEFT, RIGHT, 1e-6)
    assert found == pytest.approx(2.0 * np.hypot(0.2, 0.05), rel=0.01)


def test_there_is_no_way_to_a_place_inside_an_obstacle():
    box = Obstacle('box', (0.2, 0.0), size=(0.1, 0.1))
    assert ShortestLength([box], 0.01).to_disc(LEFT, RIGHT, 0.03) == np.inf


def test_a_tour_that_nobody_can_go_is_refused():
    scene = build_scene(
        {
            'name': 'shut',
            'waypoints': [[-0.2, 0.0], [0.2, 0.0]],
            'obstacles': [{'shape': 'box', 'center': [0.2, 0.0], 'size': [0.18, 0.18]}],
        },
        'shut.yaml',
    )  # fmt: skip
    with pytest.raises(TaskError, match=r'scene shut: a way from \[-0.2, 0.0\]') as refused:
        navigation_task(scene)
    assert isinstance(refused.value, BenchError)
