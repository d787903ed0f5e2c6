# SPDX-License-Identifier: Apache-2.0
"""The length of the shortest way around obstacles, by a visibility graph."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from srnn_config.geometry import clearance, outline
from srnn_config.scene import Obstacle

_ARC = 48
"""Corners of the polygon around a circle: arcs come out at most 0.3 % too long."""

_STEP = 0.001
"""Distance of the points of a line that are looked at [m]."""

_SLACK = 1e-6
"""How much closer than asked a line may come [m]: lines touch corners."""


class ShortestLength:
    """Corners around the obstacles of a scene, and which of them see each other."""

    def __init__(self, obstacles: Sequence[Obstacle], distance: float) -> None:
        """Find the corners.

        Args:
            obstacles: what is in the way.
            distance: what any way keeps from them [m].

        """
        self._obstacles = obstacles
        self._distance = distance
        around = [_corners(obstacle, distance) for obstacle in obstacles]
        corners = np.vstack([np.zeros((0, 2)), *around])
        self._corners = corners[clearance(corners, obstacles) >= distance]
        self._between = self._lengths(self._corners, self._corners)

    def to_disc(
        self, start: NDArray[np.float64], centre: NDArray[np.float64], radius: float
    ) -> float:
        """Return the length of the shortest way from a point (2,) into a disc [m].

        Infinite if there is none: all ways are made of lines from corner to corner.
        """
        angles = np.linspace(0.0, 2.0 * np.pi, 4 * _ARC, endpoint=False)
        towards = np.arctan2(*(self._nodes(start) - centre).T[::-1])
        rim = np.concatenate([angles, towards])
        ends = centre + radius * np.column_stack([np.cos(rim), np.sin(rim)])
        ends = ends[clearance(ends, self._obstacles) >= self._distance]
        to_end = self._lengths(self._nodes(start), ends).min(axis=1, initial=np.inf)
        left = np.concatenate([self._lengths(start[None], self._corners)[0], [0.0]])
        waiting = set(range(len(left)))
        while waiting:
            # Dijkstra: the nearest corner that has not been left yet.
            k = min(waiting, key=left.__getitem__)
            waiting.remove(k)
            if k < len(self._corners):
                left[:-1] = np.minimum(left[:-1], left[k] + self._between[k])
        return float((left + to_end).min())

    def _nodes(self, start: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(np.vstack([self._corners, start]))

    def _lengths(self, a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the lengths (n, m) of straight lines, infinite where one is not free."""
        lengths = np.linalg.norm(a[:, None] - b[None], axis=2)
        for row, origin in zip(lengths, a, strict=True):
            count = int(np.ceil(row.max(initial=0.0) / _STEP)) + 2
            share = np.linspace(0.0, 1.0, count)[:, None, None]
            points = origin + share * (b - origin)
            room = clearance(points.reshape(-1, 2), self._obstacles).reshape(count, len(b))
            row[room.min(axis=0) < self._distance - _SLACK] = np.inf
        return np.asarray(lengths)


def _corners(obstacle: Obstacle, distance: float) -> NDArray[np.float64]:
    """Return corners around an obstacle, outside of which all lines between them run."""
    disc = obstacle.shape == 'disc'
    centres = np.array([obstacle.center]) if disc else outline(obstacle)
    radius = (distance + (obstacle.radius if disc else 0.0)) / np.cos(np.pi / _ARC)
    angles = np.linspace(0.0, 2.0 * np.pi, _ARC, endpoint=False)
    circle = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    return np.asarray((centres[:, None] + circle).reshape(-1, 2))
