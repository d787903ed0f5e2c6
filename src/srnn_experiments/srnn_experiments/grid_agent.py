# SPDX-License-Identifier: Apache-2.0
"""A yardstick: A* on a grid that marks the cells around every contact."""

import numpy as np
from numpy.typing import NDArray

from srnn_experiments.agent import Brain
from srnn_experiments.grid import SIDE, centres, route
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_planner.core.planner import PlanRequest, segment_along
from srnn_planner.core.trajectory import Trajectory

MARKED = 0.02
"""Cells this close to a contact are not entered again [m]."""

TOLL = 100.0
"""What a step into a marked cell costs [cells]: the arm may stand in one, and must leave it."""

LENGTH = 0.09
"""Length of a segment [m], about that of a segment of the network."""


class GridAgent:
    """Plans the shortest way over cells that it has no bad memory of.

    It knows its own position to the millimetre and the space as a plane, neither of
    which the network is told; it generalises over nothing.
    """

    def __init__(self, brain: Brain) -> None:
        """Believe that everything is free."""
        self._brain = brain
        self._free = np.ones((SIDE, SIDE), dtype=bool)
        self._centres = centres()

    def plan(self, request: PlanRequest) -> Trajectory | None:
        """Return the first part of the shortest way, None if there is no way."""
        origin = request.measured if request.retreat_to is None else request.retreat_to
        target = self._brain.model.workspace.to_metres(request.target)
        way = route(self._free, origin, target, TOLL)
        if way is None:
            return None
        steps = self._brain.planning.sampling.steps
        path = beginning(self._straightened(way), LENGTH, steps)
        return segment_along(path, request, self._brain.planning.trajectory, self._extent)

    def learn(self, plan: Segment, executed: ExecutedPath, touched: bool) -> Dissonance | None:
        """Mark the cells around a contact, beyond the point where the arm stopped."""
        if not touched:
            return None
        stop = executed.positions[-1]
        ahead = plan.positions[-1] - stop
        centre = stop + 0.5 * MARKED * ahead / max(float(np.linalg.norm(ahead)), 1e-9)
        near = np.linalg.norm(self._centres - centre, axis=1) < MARKED
        self._free[near.reshape(SIDE, SIDE)] = False
        nothing = np.zeros(0, dtype=np.float32)
        return Dissonance(plan.stamp_ns, 'contact', True, 0, 1.0, nothing, nothing, 0.0)

    @property
    def _extent(self) -> float:
        return self._brain.model.workspace.half_extent

    def _straightened(self, way: NDArray[np.float64]) -> NDArray[np.float64]:
        """Leave out points where the straight line between their neighbours is free."""
        kept = [0]
        while kept[-1] < len(way) - 1:
            last = len(way) - 1
            while last > kept[-1] + 1 and not self._sees(way[kept[-1]], way[last]):
                last -= 1
            kept.append(last)
        return way[kept]

    def _sees(self, a: NDArray[np.float64], b: NDArray[np.float64]) -> bool:
        count = max(2, int(np.linalg.norm(b - a) / 0.004))
        line = np.linspace(a, b, count)
        distance = np.linalg.norm(line[:, None] - self._centres[~self._free.ravel()], axis=2)
        return bool(distance.size == 0 or distance.min() > 0.008)


def beginning(way: NDArray[np.float64], length: float, count: int) -> NDArray[np.float64]:
    """Return `count` evenly spaced points (count, 2) on the first `length` metres of a way."""
    steps = np.linalg.norm(np.diff(way, axis=0), axis=1)
    distance = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.linspace(0.0, min(length, float(distance[-1])), count)
    return np.stack([np.interp(at, distance, column) for column in way.T], axis=1)
