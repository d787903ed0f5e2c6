# SPDX-License-Identifier: Apache-2.0
"""How good a path is."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_bench.navigation_task import Leg, NavigationTask
from srnn_config.geometry import clearance

_STEP = 0.001
"""Distance of the points of a path that are looked at [m]."""


@dataclass(frozen=True)
class Quality:
    """What became of a leg.

    Attributes:
        reached: the way point was reached, without contact.
        ratio: length of the path, until it gets there, over the shortest.
        room: least distance between tool and obstacle on the path [m].

    """

    reached: bool
    ratio: float
    room: float


def quality(task: NavigationTask, leg: Leg, path: NDArray[np.float64]) -> Quality:
    """Judge a path (n, 2) [m] of a leg; straight lines lead from point to point.

    Whoever plans to the way point itself is judged until it counts as reached, as all others.
    """
    points = _dense(path)
    near = np.flatnonzero(np.linalg.norm(points - leg.goal, axis=1) < task.reach)
    points = points[: near[0] + 1] if len(near) else points
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    room = float(clearance(points, task.obstacles).min(initial=np.inf)) - task.radius
    return Quality(bool(len(near)) and room > 0.0, length / leg.shortest, room)


def _dense(path: NDArray[np.float64]) -> NDArray[np.float64]:
    """Put points between those of a path (n, 2)."""
    if len(path) < 2:
        return path
    lengths = np.linalg.norm(np.diff(path, axis=0), axis=1)
    pieces = [
        np.linspace(a, b, int(np.ceil(length / _STEP)) + 1)[1:]
        for a, b, length in zip(path[:-1], path[1:], lengths, strict=True)
    ]
    return np.vstack([path[:1], *pieces])
