# SPDX-License-Identifier: Apache-2.0
"""A contact is with the nearest obstacle within reach."""

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from srnn_config.geometry import clearance
from srnn_config.scene import Obstacle
from srnn_experiments.attribution import attribute

REACH = 0.02
coordinate = st.floats(-0.3, 0.3)
disc = st.builds(
    Obstacle, st.just('disc'), st.tuples(coordinate, coordinate), radius=st.floats(0.005, 0.05)
)
POST = Obstacle('disc', (0.1, 0.0), radius=0.03)
BOX = Obstacle('box', (-0.1, 0.0), size=(0.04, 0.02))


@given(
    x=coordinate, y=coordinate, groups=st.lists(st.lists(disc, min_size=1), min_size=1, max_size=3)
)
def test_of_discs_it_is_the_one_whose_centre_is_nearest_beyond_its_radius(x, y, groups):
    far = [min(np.hypot(x - o.center[0], y - o.center[1]) - o.radius for o in g) for g in groups]
    expected = int(np.argmin(far)) if min(far) <= REACH else None
    assert attribute(np.array([[x, y]]), groups, REACH) == [expected]


def test_each_contact_is_told_apart():
    points = np.array([(0.1, 0.045), (-0.1, -0.02), (0.0, 0.0), (0.055, 0.0), (-0.1, 0.0)])
    assert attribute(points, [[POST], [BOX]], REACH) == [0, 1, None, 0, 1]
    assert attribute(points, [[BOX], [POST]], REACH) == [1, 0, None, 1, 0]
    assert attribute(points, [[POST, BOX]], REACH) == [0, 0, None, 0, 0]


def test_an_obstacle_is_touched_just_within_reach():
    edge = POST.center[0] - POST.radius - REACH
    points = np.array([(edge + 1e-9, 0.0), (edge - 1e-9, 0.0)])
    assert attribute(points, [[POST]], REACH) == [0, None]
    assert clearance(points, [POST]) == pytest.approx(REACH)


def test_the_first_of_equally_near_obstacles_counts_and_nothing_is_with_nobody():
    twin = Obstacle('disc', (-0.1, 0.0), radius=0.03)
    assert attribute(np.zeros((1, 2)), [[POST], [twin]], 0.1) == [0]
    assert attribute(np.zeros((0, 2)), [[POST], [BOX]], REACH) == []
    assert attribute(np.array([(0.1, 0.04)]), [[], [POST]], REACH) == [1]
    assert attribute(np.array([(0.1, 0.04)]), [[], []], REACH) == [None]
