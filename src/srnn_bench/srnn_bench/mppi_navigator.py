# SPDX-License-Identifier: Apache-2.0
"""MPPI on the task: what paths cost, and going step by step."""

from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from srnn_bench.clearance_map import OFF_CENTRE, ClearanceMap
from srnn_bench.mppi import Mppi, MppiParameters
from srnn_bench.navigation_task import ROOM, Attempt, NavigationTask

STEPS_MAX = 400
"""Who has not arrived after so many steps does not."""

_COLLISION = 10.0
"""What a path costs that leaves less room than it must."""


class MppiNavigator:
    """Goes where the next step is planned to, until the way point is reached."""

    def __init__(self, task: NavigationTask, parameters: MppiParameters) -> None:
        """Map the obstacles."""
        self._task = task
        self._parameters = parameters
        self._map = ClearanceMap(task.obstacles)
        self._needed = task.radius + ROOM + OFF_CENTRE

    def run(self, leg: int, seed: int) -> Attempt:
        """Go a leg from rest."""
        way = self._task.legs[leg]

        def cost(paths: NDArray[np.float64]) -> NDArray[np.float64]:
            away = np.linalg.norm(paths - way.goal, axis=2)
            hit = (self._map.at(paths) < self._needed).any(axis=1)
            return np.asarray(away.mean(axis=1) + away[:, -1] + _COLLISION * hit)

        controller = Mppi(
            self._parameters, self._task.velocity, cost, np.random.default_rng(seed)
        )  # fmt: skip
        seconds, path = list[float](), [way.start]
        while len(seconds) < STEPS_MAX and np.linalg.norm(path[-1] - way.goal) >= self._task.reach:
            began = perf_counter()
            path.append(controller.step(path[-1]))
            seconds.append(perf_counter() - began)
        return Attempt(seconds, np.array(path))
