# SPDX-License-Identifier: Apache-2.0
"""Sampling-based planners of OMPL (Sucan, Moll and Kavraki 2012)."""

from math import hypot
from time import perf_counter
from typing import Any

import numpy as np
from ompl import base, geometric, util

from srnn_bench.clearance_map import CELL, OFF_CENTRE, ClearanceMap
from srnn_bench.navigation_task import NO_PATH, ROOM, Attempt, NavigationTask
from srnn_bench.ompl_budget import BUDGET
from srnn_config.scene import EDGE

_RESOLUTION = 0.002
"""Distance of the states of a motion that are checked [m]."""


class OmplNavigator:
    """Plans once, with `ROOM` between tool and obstacle, in continuous space."""

    def __init__(self, task: NavigationTask, planner: str, simplify: bool, seed: int) -> None:
        """Map the obstacles.

        Args:
            task: what is in the way.
            planner: class of the planner in `ompl.geometric`.
            simplify: shorten the path that it finds.
            seed: of the first query; OMPL derives those of the others from it.

        """
        util.setLogLevel(util.LOG_NONE)
        # OMPL takes no seed for a query; 0 would stand for the time of day.
        util.RNG.setSeed(seed + 1)
        self._task = task
        self._planner = getattr(geometric, planner)
        self._simplify = simplify
        needed = task.radius + ROOM + OFF_CENTRE
        # Rows of bytes, since single elements of an array take several times as long.
        free = ClearanceMap(task.obstacles).distances > needed
        self._free = [row.tobytes() for row in free]
        bounds = base.RealVectorBounds(2)
        bounds.setLow(-EDGE)
        bounds.setHigh(EDGE)
        self._space = base.RealVectorStateSpace(2)
        self._space.setBounds(bounds)

    def run(self, leg: int, _: int) -> Attempt:
        """Plan the way of a leg, with the next random numbers; setting the problem up counts."""
        way = self._task.legs[leg]
        began = perf_counter()
        setup = geometric.SimpleSetup(self._space)
        setup.setStateValidityChecker(self._is_free)
        setup.setStartAndGoalStates(self._state(way.start), self._state(way.goal))
        space = setup.getSpaceInformation()
        space.setStateValidityCheckingResolution(_RESOLUTION / hypot(2.0 * EDGE, 2.0 * EDGE))
        setup.setPlanner(self._planner(space))
        setup.solve(BUDGET)
        found = setup.haveExactSolutionPath()
        if found and self._simplify:
            setup.simplifySolution()
        seconds = perf_counter() - began
        if not found:
            return Attempt([seconds], NO_PATH)
        states = setup.getSolutionPath().getStates()
        return Attempt([seconds], np.array([[state[0], state[1]] for state in states]))

    def _state(self, point: Any) -> Any:
        state = self._space.allocState()
        state[0], state[1] = float(point[0]), float(point[1])
        return state

    def _is_free(self, state: Any) -> bool:
        x, y = int((state[0] + EDGE) / CELL + 0.5), int((state[1] + EDGE) / CELL + 0.5)
        return bool(self._free[x][y])
