# SPDX-License-Identifier: Apache-2.0
"""Puts together, segment by segment, what the topics tell in pieces."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from srnn_bringup.config import Configuration
from srnn_experiments.segment_record import SegmentRecord
from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import Health
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core.task import WaypointTask
from srnn_planner.core.workspace import Workspace

LATE = 2
"""A segment whose lesson is still missing when this many later ones are over gets none."""


@dataclass(eq=False)
class _Pieces:
    plan: Segment
    executed: ExecutedPath | None = None
    result: SegmentResult | None = None
    lesson: Dissonance | None = None


@dataclass(eq=False)
class Recorder:
    """Collects the events of one run; pure, told about everything by method calls.

    Attributes:
        task: way points and progress.
        workspace: converts to the units of the task.
        records: segments that are over, in the order in which they ended.
        refused: results of segments that were never executed.
        figures: last figures of the planner's health.
        force_peak: largest true contact force [N]; None before the first measurement.
        last_weights: newest weights heard of.

    """

    task: WaypointTask
    workspace: Workspace
    records: list[SegmentRecord] = field(default_factory=list)
    refused: list[SegmentResult] = field(default_factory=list)
    figures: Mapping[str, float | int | str] = field(default_factory=dict)
    force_peak: float | None = None
    last_weights: WeightsUpdate | None = None
    _open: dict[int, _Pieces] = field(default_factory=dict)
    _planning_ms: dict[int, float] = field(default_factory=dict)

    def segment(self, plan: Segment) -> None:
        """Take in a segment that was sent."""
        self._open[plan.stamp_ns] = _Pieces(plan)

    def executed(self, path: ExecutedPath) -> None:
        """Take in a measured path."""
        pieces = self._open.get(path.stamp_ns)
        if pieces is not None:
            pieces.executed = path
            self._close()

    def result(self, result: SegmentResult) -> None:
        """Take in how a segment ended."""
        pieces = self._open.get(result.stamp_ns)
        if result.code in (ResultCode.REJECTED, ResultCode.STALE):
            self._open.pop(result.stamp_ns, None)
            self.refused.append(result)
        elif pieces is not None:
            pieces.result = result
            self._close()

    def dissonance(self, lesson: Dissonance) -> None:
        """Take in what the adapter made of a segment."""
        pieces = self._open.get(lesson.segment_stamp_ns)
        if pieces is not None:
            pieces.lesson = lesson
            self._close()

    def weights(self, weights: WeightsUpdate) -> None:
        """Take in new weights."""
        self.last_weights = weights

    def force(self, newton: float) -> None:
        """Take in the size of the true contact force [N]."""
        self.force_peak = max(newton, self.force_peak or 0.0)

    def health(self, health: Mapping[str, Health]) -> None:
        """Take in the health of nodes, by full name; only an active planner has figures."""
        for name, status in health.items():
            if name.rpartition('/')[2] == 'planner' and 'planned' in status.values:
                self.figures = status.values
                if 'planning_ms' in status.values:
                    stamp_ns = int(status.values['segment_stamp_ns'])
                    self._planning_ms[stamp_ns] = float(status.values['planning_ms'])

    def _close(self) -> None:
        """Turn what is complete into records, in the order of execution."""
        over = [p for p in self._open.values() if p.executed is not None and p.result is not None]
        for index, pieces in enumerate(over):
            if pieces.lesson is None and len(over) - index <= LATE:
                return
            self._record(pieces)

    def _record(self, pieces: _Pieces) -> None:
        assert pieces.executed is not None
        assert pieces.result is not None
        del self._open[pieces.plan.stamp_ns]
        before = self.task
        end = pieces.executed.positions[-1, : before.waypoints.shape[1]]
        self.task = before.after(self.workspace.to_units(end))
        self.records.append(
            SegmentRecord(
                number=len(self.records) + 1,
                plan=pieces.plan,
                executed=pieces.executed,
                result=pieces.result,
                lesson=pieces.lesson,
                planning_ms=self._planning_ms.pop(pieces.plan.stamp_ns, None),
                before=before,
                after=self.task,
            )
        )


def start_recording(configuration: Configuration) -> Recorder:
    """Return the recorder of a run that begins."""
    workspace = configuration.network.model.workspace
    scene = configuration.scene
    waypoints = workspace.to_units(np.array(scene.waypoints))
    radius = scene.task.reach_radius / workspace.half_extent
    return Recorder(WaypointTask(waypoints, radius), workspace)
