# SPDX-License-Identifier: Apache-2.0
from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_config.geometry import clearance, outline
from srnn_config.scene import Obstacle

metres = st.floats(-0.3, 0.3)
SHAPES = [
    Obstacle('disc', (0.05, -0.02), radius=0.03),
    Obstacle('box', (0.05, -0.02), size=(0.04, 0.08), yaw=0.7),
    Obstacle('polygon', (0.0, 0.1), points=((-0.02, -0.02), (0.03, -0.01), (0.0, 0.04)), yaw=2.0),
]


@pytest.mark.parametrize(
    ('obstacle', 'area'),
    [
        (Obstacle('disc', (0.1, 0.0), radius=0.02), np.pi * 0.02**2),
        (Obstacle('box', (0.1, 0.0), size=(0.02, 0.04), yaw=0.7), 0.02 * 0.04),
        (Obstacle('polygon', (0.1, 0.0), points=((-0.01, -0.01), (0.02, -0.01), (-0.01, 0.02)),
                  yaw=2.0), 0.03 * 0.03 / 2.0),
    ],
)  # fmt: skip
def test_outlines_have_the_area_of_their_obstacle_and_surround_its_centre(obstacle, area):
    x, y = outline(obstacle).T
    shoelace = 0.5 * abs((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
    assert shoelace == pytest.approx(area, rel=0.01)
    assert min(x) < 0.1 < max(x)


def test_yaw_turns_to_the_left():
    corners = outline(Obstacle('box', (0.0, 0.0), size=(0.2, 0.0), yaw=np.pi / 2))
    assert np.abs(corners[:, 0]).max() < 1e-12
    turned = outline(Obstacle('polygon', (0.0, 0.0), points=((0.1, 0.0),) * 3, yaw=0.1))
    assert turned[0] == pytest.approx([0.1 * np.cos(0.1), 0.1 * np.sin(0.1)])


@given(x=metres, y=metres, shape=st.sampled_from(SHAPES))
def test_clearance_is_the_distance_from_the_outline(x, y, shape):
    """Against the nearest of many points on the outline."""
    corners = outline(shape)
    steps = np.linspace(0.0, 1.0, 400)[:, None, None]
    border = (corners + steps * (np.roll(corners, -1, axis=0) - corners)).reshape(-1, 2)
    expected = np.linalg.norm(border - [x, y], axis=1).min()
    found = clearance(np.array([[x, y]]), [shape])[0]
    # A disc is round, its outline has corners.
    assert abs(found) == pytest.approx(expected, abs=3e-4)


@given(u=st.floats(0.0, 0.99), v=st.floats(0.0, 1.0), shape=st.sampled_from(SHAPES))
def test_clearance_is_negative_inside_and_only_there(u, v, shape):
    corners = outline(shape)
    centre = corners.mean(axis=0)
    index = int(v * (len(corners) - 1))
    edge = corners[index]
    inside, outside = centre + u * (edge - centre), centre + (2.0 - u) * (edge - centre)
    distance = clearance(np.array([inside, outside]), [shape])
    assert distance[0] <= 1e-9
    assert distance[1] > 0.0


def test_the_nearest_of_several_obstacles_counts_and_none_is_infinitely_far():
    points = np.array([[0.05, -0.02], [0.0, 0.1]])
    assert np.isinf(clearance(points, [])).all()
    each = [clearance(points, [shape]) for shape in SHAPES]
    assert clearance(points, SHAPES) == pytest.approx(np.min(each, axis=0))
