# SPDX-License-Identifier: Apache-2.0
"""The cores of all nodes in one process, on the clock of a world."""

from time import perf_counter

import numpy as np

from srnn_config.scene import Scene
from srnn_experiments.agent import Agent
from srnn_experiments.segment_record import SegmentRecord
from srnn_experiments.world import World
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_planner.core.parameters import PlanningParameters
from srnn_planner.core.sequencer import Sequencer
from srnn_planner.core.task import WaypointTask
from srnn_planner.core.workspace import Workspace

PLANNING_TIME = 0.004
"""Planning time [s] that the schedule is told, so that runs do not depend on the machine."""

SILENCE = 60.0
"""A run in which no segment ends for so long [s] is given up: the model is dead."""


class LockStep:
    """An agent and a world with an injected clock; the task between them.

    Attributes:
        records: the segments that are over, in order.
        sequencer: task, schedule and counters.

    """

    def __init__(
        self,
        scene: Scene,
        world: World,
        agent: Agent,
        planning: PlanningParameters,
        workspace: Workspace,
    ) -> None:
        """Let `agent` move what is in `world` along the way points of `scene`."""
        self.records: list[SegmentRecord] = []
        self._world = world
        self._agent = agent
        self._sent: dict[int, tuple[Segment, float]] = {}
        units = workspace.to_units(np.array(scene.waypoints))
        task = WaypointTask(units, scene.task.reach_radius / workspace.half_extent)
        self.sequencer = Sequencer(task, workspace, planning, scene.task.velocity)

    def run(self, segments: int) -> list[SegmentRecord]:
        """Advance until that many segments are over, or nothing happens any more."""
        while len(self.records) < segments:
            before = len(self.records)
            give_up = self._world.time + SILENCE
            while len(self.records) == before:
                if self._world.time > give_up:
                    return self.records
                self.cycle()
        return self.records

    def cycle(self) -> None:
        """Advance by one cycle of the world."""
        finished = self._world.advance()
        now = self._world.time
        self.sequencer.tip(self._world.tip)
        for result, path in finished:
            if path is None:
                self._sent.pop(result.stamp_ns, None)
                self.sequencer.result(result, now)
            else:
                self._ended(result, path, now)
        self._plan(now)

    def _ended(self, result: SegmentResult, path: ExecutedPath, now: float) -> None:
        plan, planning_ms = self._sent.pop(result.stamp_ns)
        number = len(self.records) + 1
        before = self.sequencer.task
        self.sequencer.executed(result.stamp_ns, path.positions)
        lesson = self._agent.learn(plan, path, result.code is ResultCode.BLOCKED)
        after = self.sequencer.task
        self.records.append(
            SegmentRecord(number, plan, path, result, lesson, planning_ms, before, after)
        )
        self.sequencer.learned(result.stamp_ns)
        self.sequencer.result(result, now)
        self._world.set_segment(number)

    def _plan(self, now: float) -> None:
        request = self.sequencer.request(now)
        if request is None:
            return
        began = perf_counter()
        trajectory = self._agent.plan(request)
        planning_ms = 1e3 * (perf_counter() - began)
        if trajectory is None:
            self.sequencer.failed(PLANNING_TIME, now)
            return
        segment = Segment(round(now * 1e9), **vars(trajectory))
        self._sent[segment.stamp_ns] = segment, planning_ms
        self.sequencer.sent(segment.stamp_ns, trajectory, PLANNING_TIME, now)
        refused = self._world.offer(segment)
        if refused is not None:
            self._sent.pop(segment.stamp_ns)
            self.sequencer.result(refused, now)
