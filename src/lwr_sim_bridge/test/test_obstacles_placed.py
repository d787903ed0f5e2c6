# SPDX-License-Identifier: Apache-2.0
"""Obstacles can be put there and taken away while the arm moves."""

import numpy as np

from lwr_description import Mount
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.simulated_arm import SimulatedArm
from srnn_config.scene import build_scene

SCENE = {
    'name': 'two discs',
    'waypoints': [[0.0, 0.0]],
    'obstacles': [
        {'shape': 'disc', 'center': [0.1, 0.0], 'radius': 0.02, 'appears_at': 5},
        {'shape': 'disc', 'center': [0.0, 0.1], 'radius': 0.02},
    ],
}


def arm():
    scene = build_scene(SCENE, 'test')
    return SimulatedArm(ArmParameters(), Mount(), scene, np.random.default_rng(0))


def test_what_is_placed_by_hand_stays_whatever_the_scene_says():
    simulated = arm()
    assert simulated.obstacles_present == (1,)
    simulated.set_obstacle(0, True)
    simulated.set_obstacle(1, False)
    assert simulated.obstacles_present == (0,)
    simulated.set_segment(7)
    assert simulated.obstacles_present == (0,)
