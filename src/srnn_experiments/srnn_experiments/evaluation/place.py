# SPDX-License-Identifier: Apache-2.0
"""Where things are in the plane, as plain data of a figure."""

from typing import Any

from srnn_config.geometry import outline
from srnn_config.scene import Scene
from srnn_experiments.setting import Setting
from srnn_planner.core.state_neurons import StateNeurons


def place(scene: Scene) -> dict[str, Any]:
    """Return way points, their radius and the outlines of obstacles [m]."""
    return {
        'waypoints_m': [list(point) for point in scene.waypoints],
        'reach_radius_m': scene.task.reach_radius,
        'obstacles_m': [outline(obstacle).tolist() for obstacle in scene.obstacles],
    }


def neuron_positions(setting: Setting) -> list[list[float]]:
    """Return the preferred positions (K, d) of the neurons [m], one dimension after another."""
    model = setting.brain.model
    found: list[list[float]] = model.workspace.to_metres(
        StateNeurons(model.network).positions
    ).tolist()
    return found
