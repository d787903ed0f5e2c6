# SPDX-License-Identifier: Apache-2.0
"""The geometry of obstacles: outlines, and distances from them."""

from collections.abc import Iterable

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


def clearance(
    points: NDArray[np.float64], obstacles: Iterable[Obstacle]
) -> NDArray[np.float64]:
    """Return how far points are from the nearest of some convex obstacles.

    Args:
        points: (n, 2) in `srnn_workspace` [m].
        obstacles: any number of them.

    Returns:
        (n,) distance [m], negative inside an obstacle, infinite if there is none.

    """
    nearest = np.full(len(points), np.inf)
    for obstacle in obstacles:
        nearest = np.minimum(nearest, _distance(points, obstacle))
    return nearest


def _distance(points: NDArray[np.float64], obstacle: Obstacle) -> NDArray[np.float64]:
    if obstacle.shape == 'disc':
        offset = points - np.array(obstacle.center)
        return np.asarray(np.hypot(offset[:, 0], offset[:, 1]) - obstacle.radius)
    corners = outline(obstacle)
    edges = np.roll(corners, -1, axis=0) - corners
    offset = points[:, None, :] - corners[None, :, :]
    along = np.einsum('nek,ek->ne', offset, edges) / (edges**2).sum(axis=1)
    to_edge = offset - np.clip(along, 0.0, 1.0)[..., None] * edges
    distance = np.hypot(to_edge[..., 0], to_edge[..., 1]).min(axis=1)
    side = edges[:, 0] * offset[..., 1] - edges[:, 1] * offset[..., 0]
    inside = (side > 0.0).all(axis=1) | (side < 0.0).all(axis=1)
    return np.asarray(np.where(inside, -distance, distance))
