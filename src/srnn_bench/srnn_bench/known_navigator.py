# SPDX-License-Identifier: Apache-2.0
"""The planner, told of the obstacles: segment by segment, each followed perfectly."""

from time import perf_counter

import numpy as np

from srnn_bench.navigation_task import Attempt, NavigationTask
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.retreat import at_rest

PLANS_MAX = 60
"""Who has not arrived after so many segments does not."""


class KnownNavigator:
    """Plans the next segment from where the last one ends, until the way point is reached."""

    def __init__(
        self, task: NavigationTask, model: ModelParameters, planning: PlanningParameters
    ) -> None:
        """Compile what the planner needs."""
        self._task = task
        self._model = model
        self._planning = planning
        self._new_planner(0).warm_up()

    def run(self, leg: int, seed: int) -> Attempt:
        """Go a leg with a planner that has seen nothing yet."""
        way, workspace = self._task.legs[leg], self._model.workspace
        planner = self._new_planner(seed)
        motion, again = at_rest(way.start), False
        seconds, path = list[float](), [way.start[None]]
        for _ in range(PLANS_MAX):
            request = PlanRequest(
                motion.position, motion, workspace.to_units(way.goal), self._task.velocity,
                reach=self._task.reach / workspace.half_extent, again=again,
            )  # fmt: skip
            began = perf_counter()
            segment = planner.plan(request).trajectory
            seconds.append(perf_counter() - began)
            again = segment is None
            if segment is None:
                motion = at_rest(motion.position)
                continue
            path.append(segment.positions)
            motion = segment.end
            if np.linalg.norm(motion.position - way.goal) < self._task.reach:
                break
        return Attempt(seconds, np.vstack(path))

    def _new_planner(self, seed: int) -> SegmentPlanner:
        rng = np.random.default_rng(seed)
        return SegmentPlanner(self._model, self._planning, rng, self._task.obstacles)
