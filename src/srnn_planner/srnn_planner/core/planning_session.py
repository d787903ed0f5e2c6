# SPDX-License-Identifier: Apache-2.0
"""All that decides in a planner, fed by whoever hears and plans: a node, or a replay."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_config.scene import Scene
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.imagination import Imagination
from srnn_msgs_py.journal import Deed, Note, unnoted
from srnn_msgs_py.result import SegmentResult
from srnn_msgs_py.segment import ExecutedPath
from srnn_msgs_py.waypoints import Waypoints
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core.errors import PairingError
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import SegmentPlanner
from srnn_planner.core.sequencer import Sequencer
from srnn_planner.core.task import WaypointTask
from srnn_planner.core.trajectory import Trajectory
from srnn_planner.core.watched_planner import WatchedPlanner


@dataclass(frozen=True)
class Origin:
    """What a planner begins from: with the same, and fed the same, it decides the same."""

    scene: Scene
    model: ModelParameters
    planning: PlanningParameters
    seed: int


class PlanningSession:
    """Samples segments and decides when, from where and where to; notes what it acts on.

    Attributes:
        sequencer: which segment is due, from where, and when.
        watched: plans it, with weights that work.

    """

    def __init__(self, origin: Origin, note: Note = unnoted) -> None:
        """Begin with the prior weights and the way points of the scene; `note` is the journal."""
        self._note = note
        scene = origin.scene
        self._workspace = origin.model.workspace
        self._reach = scene.task.reach_radius / self._workspace.half_extent
        planner = SegmentPlanner(
            origin.model, origin.planning, np.random.default_rng([origin.seed, 0]),
            [obstacle for obstacle in scene.obstacles if obstacle.known],
        )  # fmt: skip
        self.watched = WatchedPlanner(planner, origin.planning.dead_after)
        self.sequencer = Sequencer(
            self._task(np.array(scene.waypoints)),
            self._workspace, origin.planning, scene.task.velocity,
        )  # fmt: skip

    @property
    def planner(self) -> SegmentPlanner:
        """Return what samples the segments."""
        return self.watched.planner

    def begin(self) -> None:
        """Be activated: begin with the arm as it is seen next."""
        self._note(Deed.ACTIVATED)
        self.sequencer.forget_motion()

    def blind(self) -> None:
        """Take in that nobody knows where the arm is."""
        # A segment from where the arm was would be refused, and the next one be late.
        self._note(Deed.BLIND)
        self.sequencer.forget_motion()

    def plan(self, began: float, clock: Callable[[], float]) -> Trajectory | None:
        """Return the segment that is due at `began` [s]; None for none, or no valid movement."""
        request = self.sequencer.request(began)
        if request is None:
            self._note(Deed.PLANNED, time_s=began)
            return None
        trajectory = self.watched.plan(request)
        if trajectory is None:
            planned = clock()
            self._note(Deed.PLANNED_IN_VAIN, time_s=began, until_s=planned)
            self.sequencer.failed(planned - began, planned)
        return trajectory

    def sent(self, stamp_ns: int, trajectory: Trajectory, began: float, now: float) -> None:
        """Take in that what was planned from `began` to `now` [s] is on its way."""
        self._note(Deed.PLANNED, stamp_ns, time_s=began, until_s=now)
        self.sequencer.sent(stamp_ns, trajectory, now - began, now)

    def pose(self, position: NDArray[np.float64]) -> None:
        """Take in where the tip is (3,) [m]."""
        self.sequencer.tip(position[: self._dimensions])

    def executed(self, path: ExecutedPath) -> bool:
        """Take in the measured path of a segment; return whether a way point was reached.

        Raises:
            PairingError: it has other dimensions, or numbers that are not finite.

        """
        self._note(Deed.EXECUTED, path.stamp_ns)
        positions = path.positions
        if positions.shape[1] != self._dimensions or not np.isfinite(positions).all():
            raise PairingError(f'path of segment {path.stamp_ns} is no path in the workspace')
        return self.sequencer.executed(path.stamp_ns, positions)

    def result(self, result: SegmentResult, now: float) -> None:
        """Take in how a segment ended."""
        self._note(Deed.ENDED, result.stamp_ns, result.digest(), now)
        self.sequencer.result(result, now)

    def lesson(self, lesson: Dissonance) -> None:
        """Take in that the adapter is through with a segment."""
        self._note(Deed.LEARNED, lesson.segment_stamp_ns)
        # Weights travel on a topic of their own and may be behind this message.
        if not lesson.updated or lesson.weights_version <= self.watched.watch.newest_version:
            self.sequencer.learned(lesson.segment_stamp_ns)

    def weights(self, update: WeightsUpdate) -> None:
        """Take in new weights.

        Raises:
            WeightsError: they must not take the place of those in use.

        """
        self._note(Deed.WEIGHTS, update.version, update.checksum())
        self.watched.take(update)
        self.sequencer.learned(update.segment_stamp_ns)

    def tour(self, tour: Waypoints) -> None:
        """Take in other way points.

        Raises:
            SrnnError: they are none.

        """
        self._note(Deed.TOUR, tour.stamp_ns)
        self.sequencer.task = self._task(tour.points[:, : self._dimensions])

    def waypoints(self, stamp_ns: int) -> Waypoints:
        """Return the way points of now, in metres."""
        return Waypoints(stamp_ns, self._workspace.to_metres(self.sequencer.task.waypoints))

    def imagination(self, stamp_ns: int) -> Imagination | None:
        """Return what the last segment was chosen from; None before the first."""
        plan = self.watched.last
        if plan is None:
            return None
        spikes = np.minimum(plan.spikes, 255).astype(np.uint8)
        metres = self._workspace.to_metres(plan.samples).astype(np.float32)
        return Imagination(stamp_ns, metres, plan.kept, spikes)

    def _task(self, metres: NDArray[np.float64]) -> WaypointTask:
        return WaypointTask(self._workspace.to_units(metres), self._reach)

    @property
    def _dimensions(self) -> int:
        return self.planner.model.network.dimensions
