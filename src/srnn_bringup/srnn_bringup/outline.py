# SPDX-License-Identifier: Apache-2.0
"""Outlines of obstacles as closed polygons."""

import numpy as np
from numpy.typing import NDArray

from srnn_config.scene import Obstacle

_ROUND = 48
"""Corners of a polygon that passes for a disc."""


def outline(obstacle: Obstacle) -> NDArray[np.float64]:
    """Return the corners (n, 2) of an obstacle in `srnn_workspace` [m]."""
    if obstacle.shape == 'disc':
        angles = np.linspace(0.0, 2.0 * np.pi, _ROUND, endpoint=False)
        corners = obstacle.radius * np.column_stack([np.cos(angles), np.sin(angles)])
    elif obstacle.shape == 'box':
        signs = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
        corners = signs * np.array(obstacle.size) / 2.0
    else:
        corners = np.array(obstacle.points)
    cos, sin = np.cos(obstacle.yaw), np.sin(obstacle.yaw)
    return np.asarray(corners @ np.array([[cos, sin], [-sin, cos]]) + obstacle.center)
