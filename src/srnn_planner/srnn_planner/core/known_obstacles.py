# SPDX-License-Identifier: Apache-2.0
"""Obstacles that the planner is told of, as inhibitory context input."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from srnn_config.geometry import clearance
from srnn_config.scene import Obstacle
from srnn_planner.core.parameters import ObstacleParameters


def obstacle_input(
    positions: NDArray[np.float64], obstacles: Iterable[Obstacle], parameters: ObstacleParameters
) -> NDArray[np.float64]:
    """Return the constant input of context neurons that stand for obstacles.

    They spike all the time and inhibit the state neurons in and around an obstacle: all
    of those within a margin, farther ones as a Gaussian of the distance.

    Args:
        positions: (K, 2) preferred positions of the state neurons [m].
        obstacles: any number of them.
        parameters: strength and shape of the inhibition.

    Returns:
        (K,) input, at most 0, to be added to the membrane potentials.

    """
    p = parameters
    beyond = np.maximum(clearance(positions, obstacles) - p.margin, 0.0)
    return np.asarray(-p.strength * np.exp(-0.5 * (beyond / p.falloff) ** 2))
