# SPDX-License-Identifier: Apache-2.0
"""The cores of all nodes in one process, on the clock of the simulated arm."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics, Mount
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.simulated_arm import SimulatedArm
from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.tracker import Tracker
from srnn_config.scene import Scene
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_planner.core.adapter import Learner
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import SegmentPlanner
from srnn_planner.core.sequencer import Sequencer
from srnn_planner.core.task import WaypointTask

TICKS_PER_SAMPLE = 4
"""The arm is measured and commanded at 250 Hz."""

PLANNING_TIME = 0.004
"""Planning time [s] that the schedule is told, so that runs do not depend on the machine."""


@dataclass
class Log:
    """What happened.

    Attributes:
        segments: every plan that was sent, by identity.
        results: of the segments that were executed, in order.
        paths: measured paths, by identity.
        updates: numbers of the segments that changed the weights.
        reached: number of the segment and index of the way point it reached.
        force_peak: largest low-passed true contact force [N].

    """

    segments: dict[int, Segment] = field(default_factory=dict)
    results: list[SegmentResult] = field(default_factory=list)
    paths: dict[int, ExecutedPath] = field(default_factory=dict)
    updates: list[int] = field(default_factory=list)
    reached: list[tuple[int, int]] = field(default_factory=list)
    force_peak: float = 0.0

    @property
    def contacts(self) -> list[int]:
        """Numbers of the segments that were blocked."""
        return [n for n, r in enumerate(self.results) if r.code is ResultCode.BLOCKED]

    def rmse(self) -> float:
        """Root mean square distance of plan and execution over unblocked segments [m]."""
        done = [r.stamp_ns for r in self.results if r.code is ResultCode.DONE]
        errors = [self.segments[s].positions - self.paths[s].positions for s in done]
        return float(np.sqrt(np.mean(np.sum(np.concatenate(errors) ** 2, axis=1))))


class LockStep:
    """Planner, tracker, adapter and arm with an injected clock.

    Attributes:
        log: what happened.
        command: (7,) last joint command [rad], None before the first.

    """

    def __init__(
        self,
        scene: Scene,
        seed: int,
        model: ModelParameters,
        planning: PlanningParameters,
        tracking: TrackerParameters | None = None,
        arm: ArmParameters | None = None,
    ) -> None:
        """Put arm, tracker, planner and learner of one seed into a scene."""
        mount = Mount()
        self.log = Log()
        self.command: NDArray[np.float64] | None = None
        self.arm = SimulatedArm(
            arm or ArmParameters(), mount, scene, np.random.default_rng([seed, 2])
        )
        self.tracker = Tracker(tracking or TrackerParameters(), Kinematics(mount))
        self.planner = SegmentPlanner(model, planning, np.random.default_rng([seed, 0]))
        self.learner = Learner(model, np.random.default_rng([seed, 1]))
        units = model.workspace.to_units(np.array(scene.waypoints))
        task = WaypointTask(units, scene.task.reach_radius / model.workspace.half_extent)
        self.sequencer = Sequencer(task, model.workspace, planning, scene.task.velocity)

    def run(self, segments: int, longest: float = 1000.0) -> Log:
        """Advance until `segments` have ended, or `longest` simulated seconds."""
        while len(self.log.results) < segments and self.arm.time < longest:
            self.cycle()
        self.log.force_peak = self.arm.truth.peak
        return self.log

    def cycle(self) -> None:
        """Advance by one measurement of the arm."""
        for _ in range(TICKS_PER_SAMPLE):
            self.arm.step()
        now = self.arm.time
        tick = self.tracker.tick(now, self.arm.sample(round(now * 1e9)))
        self.command = tick.command
        if tick.command is not None:
            self.arm.command(tick.command)
        self.sequencer.tip(self.tracker.tip[:2].copy())
        for result, path in tick.finished:
            self._ended(result, path, now)
        self._plan(now)

    def _ended(self, result: SegmentResult, path: ExecutedPath | None, now: float) -> None:
        if path is None:
            self.sequencer.result(result, now)
            return
        number = len(self.log.results)
        self.log.results.append(result)
        self.log.paths[result.stamp_ns] = path
        active = self.sequencer.task.active
        if self.sequencer.executed(result.stamp_ns, path.positions):
            self.log.reached.append((number, active))
        plan = self.log.segments[result.stamp_ns]
        if self.learner.learn(plan.positions, path.positions).updated:
            self.log.updates.append(number)
            self.planner.use_weights(self.learner.weights)
        self.sequencer.learned(result.stamp_ns)
        self.sequencer.result(result, now)
        self.arm.set_segment(number + 1)

    def _plan(self, now: float) -> None:
        request = self.sequencer.request(now)
        if request is None:
            return
        trajectory = self.planner.plan(request).trajectory
        if trajectory is None:
            self.sequencer.failed(PLANNING_TIME, now)
            return
        segment = Segment(round(now * 1e9), **vars(trajectory))
        self.log.segments[segment.stamp_ns] = segment
        self.sequencer.sent(segment.stamp_ns, trajectory, PLANNING_TIME, now)
        refused = self.tracker.offer(segment, 0.0)
        if refused is not None:
            self.sequencer.result(refused, now)
