# SPDX-License-Identifier: Apache-2.0
"""Which segment is planned next, from where, and when; a state machine with injected time."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_planner.core.parameters import PlanningParameters
from srnn_planner.core.planner import PlanRequest
from srnn_planner.core.retreat import Trail, at_rest
from srnn_planner.core.schedule import PlanningSchedule
from srnn_planner.core.task import WaypointTask
from srnn_planner.core.trajectory import Trajectory
from srnn_planner.core.workspace import Workspace

RETRY = 0.1
"""Pause before planning again after a rejected segment or an invalid plan [s]."""

PATIENCE = 4
"""The pause doubles with every further rejection in a row, this many times."""

RETREATS = 4
"""The way back grows with every contact in a row, up to this many times the first, then anew."""

LOST_AFTER = 1.0
"""A segment without a result this long after its expected end counts as lost [s]."""


@dataclass(frozen=True, eq=False)
class Flight:
    """A segment on its way: identity, motion and when it starts or started [s]."""

    stamp_ns: int
    trajectory: Trajectory
    start: float

    @property
    def end(self) -> float:
        """Time of its expected end [s]."""
        return self.start + self.trajectory.duration


@dataclass
class Counters:
    """What happened so far, for diagnostics."""

    planned: int = 0
    invalid_plans: int = 0
    contacts: int = 0
    rejected: int = 0
    deadline_misses: int = 0
    lost: int = 0


class Sequencer:
    """Keeps the arm supplied with segments, one running and one waiting at most.

    Feed it what arrives (`tip`, `executed`, `result`, `learned`), ask `request` for
    the plan that is due, and report back with `sent` or `failed`. All times are
    seconds of one steady clock.
    """

    def __init__(
        self,
        task: WaypointTask,
        workspace: Workspace,
        planning: PlanningParameters,
        velocity: float,
    ) -> None:
        """Start at rest; nothing is due before the first `tip`."""
        self.task = task
        self.counters = Counters()
        self.schedule = PlanningSchedule(planning.schedule)
        self._workspace = workspace
        self._planning = planning
        self._velocity = velocity
        self._trail = Trail()
        self._tip: NDArray[np.float64] | None = None
        self._running: Flight | None = None
        self._waiting: Flight | None = None
        self._touched: int | None = None
        self._executed_stamp = self._learned_stamp = 0
        self._retreating = False
        self._touches_in_a_row = 0
        self._refused_in_a_row = 0
        self._in_vain = False
        self._not_before = 0.0

    @property
    def velocity(self) -> float:
        """Execution speed of the segments [m/s]."""
        return self._velocity

    def tip(self, position: NDArray[np.float64]) -> None:
        """Take in the measured tip (d,) [m]."""
        self._tip = position

    def executed(self, stamp_ns: int, positions: NDArray[np.float64]) -> bool:
        """Take in the measured path (T, d) [m] of a segment; True if a way point was reached."""
        self._trail.extend(positions)
        self._executed_stamp = stamp_ns
        self._end_wait_for_learning()
        before = self.task
        self.task = before.after(self._workspace.to_units(positions[-1]))
        return self.task is not before

    def learned(self, stamp_ns: int) -> None:
        """Take in that the adapter is through with a segment."""
        self._learned_stamp = stamp_ns
        self._end_wait_for_learning()

    def result(self, result: SegmentResult, now: float) -> None:
        """Take in how a segment ended; results of segments of others are ignored."""
        flight = self._flight(result.stamp_ns)
        if flight is None:
            return
        if result.code in (ResultCode.REJECTED, ResultCode.STALE, ResultCode.FAULT):
            self._refused(flight, now)
            return
        self._refused_in_a_row = 0
        self._in_vain = False
        if result.code is ResultCode.DONE:
            self._done(now)
        else:
            self._blocked(result.stamp_ns, now)

    def wake_time(self) -> float | None:
        """Return when `request` should be asked next [s], None if only events matter."""
        if self._tip is None or self._waiting is not None:
            return self._running.end + LOST_AFTER if self._running else None
        if self._running is None:
            return self._not_before
        start = self.schedule.start(self._running.start, self._running.trajectory.duration)
        return max(start, self._not_before)

    def request(self, now: float) -> PlanRequest | None:
        """Return what to plan now, or None if nothing is due."""
        self._give_up_lost(now)
        if self._tip is None or self._waiting is not None or now < (self.wake_time() or 0.0):
            return None
        if self._running is not None:
            return self._onward(self._running, now)
        return PlanRequest(
            self._tip, at_rest(self._tip), self.task.target, self._velocity,
            self._retreat(), self.task.reach_radius, self._in_vain,
        )

    def sent(self, stamp_ns: int, trajectory: Trajectory, seconds: float, now: float) -> None:
        """Report that a plan was published; `seconds` is what planning took."""
        self.schedule.record(seconds)
        self.counters.planned += 1
        self._retreating = False
        if self._running is None:
            self._running = Flight(stamp_ns, trajectory, now)
        else:
            self._waiting = Flight(stamp_ns, trajectory, self._running.end)

    def failed(self, seconds: float, now: float) -> None:
        """Report that no valid movement was found."""
        self.schedule.record(seconds)
        self.counters.invalid_plans += 1
        self._in_vain = True
        self._not_before = now + (RETRY if self._running is None else 0.0)

    def forget_motion(self) -> None:
        """Drop what is in flight, as after a deactivation; the task is kept."""
        self._running = self._waiting = self._tip = None
        self._touched = None
        self._retreating = False
        self._not_before = 0.0

    def _onward(self, running: Flight, now: float) -> PlanRequest:
        assert self._tip is not None
        plan, elapsed = running.trajectory, now - running.start
        end = plan.end
        columns = [np.interp(elapsed, plan.times, column) for column in plan.positions.T]
        ahead = self.task.after(self._workspace.to_units(end.position))
        measured = end.position + self._tip - np.array(columns)
        return PlanRequest(
            measured, end, ahead.target, self._velocity,
            reach=ahead.reach_radius, again=self._in_vain,
        )

    def _retreat(self) -> NDArray[np.float64] | None:
        """Return where to go back to, for every contact in a row somewhere else.

        A way back may itself be blocked, if the arm did not come from there straight.
        """
        if not self._retreating or not self._executed_stamp:
            # Of a contact whose path was never heard nobody knows the way back.
            return None
        times = (self._touches_in_a_row - 1) % RETREATS + 1
        return self._trail.back(times * self._planning.trajectory.retreat)

    def _flight(self, stamp_ns: int) -> Flight | None:
        flights = (self._running, self._waiting)
        return next((f for f in flights if f is not None and f.stamp_ns == stamp_ns), None)

    def _done(self, now: float) -> None:
        self._touches_in_a_row = 0
        if self._waiting is None:
            self.counters.deadline_misses += 1
            self._running = None
        else:
            waiting = self._waiting
            self._running = Flight(waiting.stamp_ns, waiting.trajectory, now)
            self._waiting = None

    def _blocked(self, stamp_ns: int, now: float) -> None:
        self.counters.contacts += 1
        self._touches_in_a_row += 1
        self._running = self._waiting = None
        self._retreating = True
        self._touched = stamp_ns
        self._not_before = now + self._planning.schedule.learning_wait
        self._end_wait_for_learning()

    def _refused(self, flight: Flight, now: float) -> None:
        self.counters.rejected += 1
        if flight is self._running:
            self._running = None
        self._waiting = None
        running_until = self._running.end if self._running is not None else now
        pause = RETRY * 2.0 ** min(self._refused_in_a_row, PATIENCE)
        self._refused_in_a_row += 1
        self._in_vain = True
        self._not_before = max(now, running_until) + pause

    def _end_wait_for_learning(self) -> None:
        """Go on as soon as path and lesson of the last contact are in, in any order."""
        if self._touched == self._executed_stamp == self._learned_stamp:
            self._touched = None
            self._not_before = 0.0

    def _give_up_lost(self, now: float) -> None:
        if self._running is not None and now > self._running.end + LOST_AFTER:
            self.counters.lost += 1
            self._in_vain = True
            self._running = self._waiting = None
