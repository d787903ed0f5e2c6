# SPDX-License-Identifier: Apache-2.0
"""The task with a known obstacle: from way point to way point of a scene."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_bench.errors import TaskError
from srnn_bench.shortest_length import ShortestLength
from srnn_config.scene import Obstacle, Scene

ROOM = 0.005
"""Room that peers leave between tool and obstacle [m]: a tracking error that stops the arm."""


@dataclass(frozen=True, eq=False)
class Leg:
    """The way from one way point to the next.

    Attributes:
        start: (2,) [m].
        goal: (2,) [m].
        shortest: length of the shortest way free of contact, until the goal is reached [m].

    """

    start: NDArray[np.float64]
    goal: NDArray[np.float64]
    shortest: float


@dataclass(frozen=True, eq=False)
class NavigationTask:
    """A point that stands for the tool, obstacles that are known, and where to go.

    Attributes:
        obstacles: those that stand there from the beginning.
        radius: of the tool [m].
        reach: a way point is reached when the tool is closer than this [m].
        velocity: speed [m/s].
        legs: the tour.
        blocked: number of the leg whose way point is behind the obstacle.

    """

    obstacles: tuple[Obstacle, ...]
    radius: float
    reach: float
    velocity: float
    legs: tuple[Leg, ...]
    blocked: int


@dataclass(frozen=True, eq=False)
class Attempt:
    """How somebody went a leg.

    Attributes:
        seconds: time of each planning.
        path: (n, 2) from the start on [m]; empty if there was none.

    """

    seconds: Sequence[float]
    path: NDArray[np.float64]


NO_PATH = np.zeros((0, 2))
"""The path of an attempt that came to nothing."""


def navigation_task(scene: Scene) -> NavigationTask:
    """Return the task of a scene: all its way points in turn, each leg from rest.

    Raises:
        TaskError: there is no way to a way point that is free of contact.

    """
    from lwr_description import Mount

    obstacles = tuple(o for o in scene.obstacles if o.present(0))
    radius, reach = Mount().tool_radius, scene.task.reach_radius
    points = np.array(scene.waypoints)
    lengths = ShortestLength(obstacles, radius)
    legs = tuple(
        Leg(start, goal, lengths.to_disc(start, goal, reach))
        for start, goal in zip(points, np.roll(points, -1, axis=0), strict=True)
    )
    for leg in legs:
        if not 0.0 < leg.shortest < np.inf:
            raise TaskError(
                f'scene {scene.task.name}: a way from {leg.start.tolist()} to '
                f'{leg.goal.tolist()} that is free of contact must have a length, and be there'
            )
    blocked = (scene.task.blocked - 1) % len(legs)
    return NavigationTask(obstacles, radius, reach, scene.task.velocity, legs, blocked)
