# SPDX-License-Identifier: Apache-2.0
"""The shortest way on a grid: the A* of the experiments."""

from time import perf_counter

from srnn_bench.navigation_task import NO_PATH, ROOM, Attempt, NavigationTask
from srnn_config.geometry import clearance
from srnn_experiments.grid import SIDE, centres, route


class GridNavigator:
    """Plans once, with `ROOM` between tool and obstacle."""

    def __init__(self, task: NavigationTask) -> None:
        """Mark the cells that are free."""
        room = clearance(centres(), task.obstacles) - task.radius
        self._task = task
        self._free = (room > ROOM).reshape(SIDE, SIDE)

    def run(self, leg: int, _: int) -> Attempt:
        """Plan the way of a leg, which is the same for all seeds."""
        way = self._task.legs[leg]
        began = perf_counter()
        path = route(self._free, way.start, way.goal)
        return Attempt([perf_counter() - began], NO_PATH if path is None else path)
