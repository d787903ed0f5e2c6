# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from srnn_bench.mppi import Mppi, MppiParameters

START, GOAL = np.array([-0.12, 0.0]), np.array([0.12, 0.0])
VELOCITY = 0.1


def drive(seed, radius):
    """Go from start to goal around a disc in the middle; return the path (n, 2)."""

    def cost(paths):
        away = np.linalg.norm(paths - GOAL, axis=2)
        hit = (np.linalg.norm(paths, axis=2) < radius).any(axis=1)
        return away.mean(axis=1) + away[:, -1] + 10.0 * hit

    controller = Mppi(MppiParameters(), VELOCITY, cost, np.random.default_rng(seed))
    path = [START]
    while np.linalg.norm(path[-1] - GOAL) > 0.03 and len(path) < 300:
        path.append(controller.step(path[-1]))
    return np.array(path)


@pytest.mark.parametrize('seed', range(4))
def test_the_goal_is_reached_around_an_obstacle(seed):
    path = drive(seed, radius=0.04)
    assert np.linalg.norm(path[-1] - GOAL) <= 0.03
    # A mean of free paths may cut a corner, by less than a step.
    assert np.linalg.norm(path, axis=1).min() > 0.04 - VELOCITY * MppiParameters().period


def test_nothing_in_the_way_means_almost_straight():
    path = drive(0, radius=0.0)
    assert np.linalg.norm(np.diff(path, axis=0), axis=1).sum() < 0.24


def test_the_speed_has_a_limit_and_seeds_decide():
    path = drive(5, radius=0.04)
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    assert steps.max() <= VELOCITY * MppiParameters().period * (1.0 + 1e-9)
    np.testing.assert_array_equal(path, drive(5, radius=0.04))
