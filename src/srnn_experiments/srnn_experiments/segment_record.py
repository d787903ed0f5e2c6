# SPDX-License-Identifier: Apache-2.0
"""What is known of a segment when it is over."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_planner.core.task import WaypointTask


@dataclass(frozen=True, eq=False)
class SegmentRecord:
    """One segment that the arm has executed, or begun to.

    Attributes:
        number: 1 for the first segment of the run.
        plan: the segment as it was sent.
        executed: what the arm did.
        result: how it ended.
        lesson: what the adapter made of it; None if nothing was heard.
        planning_ms: time that planning took [ms]; None if nothing was heard.
        before: the task when the segment ended.
        after: the task with its end taken into account.

    """

    number: int
    plan: Segment
    executed: ExecutedPath
    result: SegmentResult
    lesson: Dissonance | None
    planning_ms: float | None
    before: WaypointTask
    after: WaypointTask

    @property
    def touched(self) -> bool:
        """Tell whether the segment ended in a contact."""
        return self.result.code is ResultCode.BLOCKED

    @property
    def updated(self) -> bool:
        """Tell whether the segment changed the weights."""
        return self.lesson is not None and self.lesson.updated

    @property
    def length(self) -> float:
        """Length of the planned path [m]."""
        return path_length(self.plan.positions)

    @property
    def reached(self) -> bool:
        """Tell whether the segment ended at its way point."""
        return self.after.reached > self.before.reached


def path_length(positions: NDArray[np.float64]) -> float:
    """Return the length [m] of a path (T, d) [m]."""
    return float(np.linalg.norm(np.diff(positions, axis=0), axis=1).sum())
