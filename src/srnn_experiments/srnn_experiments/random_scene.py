# SPDX-License-Identifier: Apache-2.0
"""Random scenes that can be solved, one for each seed."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lwr_description import Mount
from srnn_config.geometry import clearance
from srnn_config.scene import Obstacle, Scene, SceneTask
from srnn_experiments.errors import SceneError
from srnn_experiments.grid import SIDE, centres, route

ROOM = 0.03
"""Distance that a way round leaves between the tool and any obstacle [m]."""

REACH = 0.22
"""Way points lie within this distance of the centre, along each axis [m]."""

APART = 0.14
"""Least distance of way points that follow each other [m]."""

TRIES = 10_000


def random_scene(seed: int) -> Scene:
    """Return the scene of a seed: three to five way points, one or two obstacles between.

    Every obstacle stands on the straight line between two way points that follow each
    other; the second of the first such pair is the blocked one. A scene is solvable:
    see `is_solvable`.

    Raises:
        SceneError: no solvable scene was found, which no seed has shown so far.

    """
    rng = np.random.default_rng([seed, 17])
    for _ in range(TRIES):
        scene = _draw(rng, f'random_{seed}')
        if scene is not None and is_solvable(scene):
            return scene
    raise SceneError(f'seed {seed}: no solvable scene in {TRIES} tries')


def is_solvable(scene: Scene, room: float = ROOM) -> bool:
    """Tell whether the tool can go from way point to way point with `room` [m] to spare.

    All obstacles count, whenever they appear.
    """
    needed = Mount().tool_radius + room
    points = np.array([scene.start, *scene.waypoints, scene.waypoints[0]])
    if clearance(points, scene.obstacles).min() < needed:
        return False
    free = (clearance(centres(), scene.obstacles) > needed).reshape(SIDE, SIDE)
    return all(route(free, a, b) is not None for a, b in pairwise(points))


def _draw(rng: np.random.Generator, name: str) -> Scene | None:
    waypoints = rng.uniform(-REACH, REACH, (int(rng.integers(3, 6)), 2)).round(3)
    legs = np.linalg.norm(np.roll(waypoints, -1, axis=0) - waypoints, axis=1)
    if legs.min() < APART:
        return None
    count = 1 if rng.random() < 0.7 else 2
    chosen = rng.choice(len(waypoints), size=count, replace=False)
    obstacles = tuple(
        _obstacle(rng, waypoints[i], waypoints[(i + 1) % len(waypoints)]) for i in chosen
    )
    return Scene(
        task=SceneTask(name=name, blocked=int(chosen[0] + 1) % len(waypoints)),
        waypoints=tuple((float(x), float(y)) for x, y in waypoints),
        obstacles=obstacles,
        start=(float(waypoints[0, 0]), float(waypoints[0, 1])),
    )


def _obstacle(
    rng: np.random.Generator, a: NDArray[np.float64], b: NDArray[np.float64]
) -> Obstacle:
    """Put a random shape on the way from `a` to `b`, a little off the line."""
    across = np.array([a[1] - b[1], b[0] - a[0]]) / np.linalg.norm(b - a)
    middle = a + rng.uniform(0.4, 0.6) * (b - a) + rng.uniform(-0.01, 0.01) * across
    center = (round(float(middle[0]), 3), round(float(middle[1]), 3))
    yaw = round(float(rng.uniform(-np.pi, np.pi)), 2)
    shape = str(rng.choice(['disc', 'box', 'polygon']))
    if shape == 'disc':
        return Obstacle(shape, center, radius=round(float(rng.uniform(0.012, 0.035)), 3))
    if shape == 'box':
        width, depth = rng.uniform(0.02, 0.08), rng.uniform(0.015, 0.04)
        return Obstacle(shape, center, size=(round(width, 3), round(depth, 3)), yaw=yaw)
    angles = np.linspace(0.0, 2.0 * np.pi, int(rng.integers(3, 7)), endpoint=False)
    radius = rng.uniform(0.018, 0.035)
    points = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    corners = tuple((round(float(x), 4), round(float(y), 4)) for x, y in points)
    return Obstacle(shape, center, points=corners, yaw=yaw)
