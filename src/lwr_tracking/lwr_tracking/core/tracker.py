# SPDX-License-Identifier: Apache-2.0
"""The tracker: segments and measurements in, joint commands and results out."""

from math import isfinite, nan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_tracking.core.contact_observer import ContactObserver, Touch
from lwr_tracking.core.counters import Counters
from lwr_tracking.core.errors import ClockError
from lwr_tracking.core.execution import Execution, Finished
from lwr_tracking.core.failsafe import Condition, Reaction, decide
from lwr_tracking.core.load_check import LoadCheck
from lwr_tracking.core.motion_watch import MotionWatch
from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.perception import Perception
from lwr_tracking.core.point import Point
from lwr_tracking.core.reference import Reference
from lwr_tracking.core.refusal import Refusal
from lwr_tracking.core.repeated_stops import RepeatedStops
from lwr_tracking.core.segment_gate import Admission, Join, judge
from lwr_tracking.core.tick_watch import AT_REST_AFTER, TickWatch
from lwr_tracking.core.tracking_law import TrackingLaw
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import Segment

Array = NDArray[np.float64]


class Tick(NamedTuple):
    """Answer to one measurement.

    Attributes:
        command: (n,) joint angles to send [rad]; None before the first good measurement.
        finished: results since the last tick.

    """

    command: Array | None
    finished: tuple[Finished, ...]


class Tracker:
    """Follows accepted segments, stops on contact, freezes on faults until reset.

    One `tick` per measurement, one command per tick; segments are offered in between.
    Without segments the last reference is held. When nothing runs, force is ignored
    (people may lean on the arm), but an arm pushed off its reference by more than the
    contact error gives way: it holds where it was pushed to.

    Attributes:
        conditions: what is wrong, or asked for, now.
        counters: what happened so far.

    """

    def __init__(self, parameters: TrackerParameters, kinematics: Kinematics) -> None:
        """Wait for the first measurement."""
        self.conditions = Condition.NOT_STARTED
        self.counters = Counters()
        self._parameters = parameters
        self._perception = Perception(parameters, kinematics)
        self._tip: Point = (nan, nan, nan)
        self._law = TrackingLaw(parameters.law, parameters.limits, kinematics)
        self._ticks = TickWatch(parameters.period)
        self._last_stamp_ns: int | None = None
        self._finished: list[Finished] = []
        self._begin()

    def _begin(self) -> None:
        """Know nothing of the arm yet."""
        parameters = self._parameters
        self._contact = ContactObserver(parameters.contact)
        self._perception.restart()
        self._motion = MotionWatch(parameters.limits)
        self._stops = RepeatedStops(parameters.contact)
        self._load: LoadCheck | None = LoadCheck(parameters.contact.rearm_force)
        self._execution: Execution | None = None
        self._now: float | None = None

    @property
    def tip(self) -> Array:
        """Return the last measured tip (3,) in `srnn_workspace` [m]; NaN before the first."""
        return np.array(self._tip)

    @property
    def reference(self) -> Reference | None:
        """Return what is commanded, None before the first good measurement."""
        return self._execution.reference if self._execution else None

    @property
    def contact(self) -> ContactObserver:
        """Return the force and the error of the last measurement."""
        return self._contact

    @property
    def correction(self) -> Array:
        """Return the integral correction of the commanded tip (3,) [m]."""
        return np.array(self._law.correction)

    @property
    def latched(self) -> bool:
        """Tell whether the arm is frozen until `reset`."""
        return decide(self.conditions).until_reset

    def offer(self, segment: Segment, age_s: float) -> SegmentResult | None:
        """Ask for a segment to be executed after what runs now.

        Args:
            segment: anything that arrived as a segment.
            age_s: time since it was stamped [s].

        Returns:
            None if it was accepted, else its result; then nothing has changed.

        """
        verdict = self._judge(segment, age_s)
        if isinstance(verdict, Refusal):
            self.counters.refuse(verdict)
            code = ResultCode.STALE if verdict is Refusal.STALE else ResultCode.REJECTED
            return SegmentResult(segment.stamp_ns, code, self._words(verdict))
        assert self._execution is not None
        self.counters.accepted += 1
        self._load = None
        self._last_stamp_ns = segment.stamp_ns
        self._finish(self._execution.accept(verdict))
        return None

    def tick(self, now: float, sample: JointSample) -> Tick:
        """Answer one measurement with one command.

        Args:
            now: steady-clock time [s]; between ticks at most `limits.max_step` counts.
            sample: what the arm measured.

        Raises:
            ClockError: `now` is not finite.

        """
        elapsed = self._elapsed(now)
        self._keep_time(elapsed)
        dt = min(elapsed, self._parameters.limits.max_step)
        law, started = self._law, self._execution is not None
        wrong, strained, tip, force = self._perception.take(sample, law.command, started)
        if wrong is not Condition.NONE and wrong is not Condition.DIVERGED:
            self._distrust(wrong)
            return self._answer()
        self._tip = tip
        execution = self._execution or self._start(sample)
        if wrong is Condition.DIVERGED:
            self._fault(wrong)
            law.follow(sample.position, dt)
            return self._answer()
        self._advance(execution, now, dt, force)
        law.step(execution.reference.place, dt, settle=not self.latched)
        hindrance = self._motion.judge(dt, law.freedom, strained, execution.running)
        # Once only: a point that is held must not wander with the arm.
        if hindrance is not Condition.NONE and hindrance & ~self.conditions:
            self._fault(hindrance)
        return self._answer()

    def stop(self) -> None:
        """Freeze at the measured tip, now and until `reset`; the running segment FAULTs."""
        self._fault(Condition.STOPPED)

    def silence(self) -> None:
        """Freeze as after `stop`, because measurements have ceased."""
        self._fault(Condition.SILENT)

    def reset(self) -> None:
        """Forget latched faults, and hold the arm where it is measured next.

        It may be far from its last command: another arm may have been started in its place.
        """
        latched = decide(self.conditions).latched
        if latched:
            self._begin()
            self.conditions = self.conditions & ~latched | Condition.NOT_STARTED

    def restore(self, conditions: Condition) -> None:
        """Be stopped until `reset` by what had stopped a predecessor."""
        self.conditions |= decide(conditions).latched

    def pause(self) -> None:
        """Come to rest on the path and refuse segments until `resume`."""
        self.conditions |= Condition.PAUSED

    def resume(self) -> None:
        """Run on from where `pause` stopped."""
        self.conditions &= ~Condition.PAUSED

    def _words(self, refusal: Refusal) -> str:
        """Return the reason of a refusal, and what has stopped the arm if that is it."""
        if refusal is not Refusal.STOPPED:
            return str(refusal)
        return f'{refusal}: {", ".join(decide(decide(self.conditions).latched).causes)}'

    def _judge(self, segment: Segment, age_s: float) -> Admission | Refusal:
        if self._execution is None:
            return Refusal.NOT_STARTED
        if self.latched:
            return Refusal.STOPPED
        if Condition.LOADED in self.conditions:
            return Refusal.LOADED
        if Condition.PAUSED in self.conditions:
            return Refusal.PAUSED
        state, late = self._execution.reference.join()
        return judge(segment, Join(state, late, self._last_stamp_ns), age_s, self._parameters)

    def _elapsed(self, now: float) -> float:
        """Return the time since the last tick [s], 0 at the first and if it went backward."""
        if not isfinite(now):
            raise ClockError(f'now = {now}: must be a finite time in seconds')
        before, self._now = self._now, now
        return 0.0 if before is None else max(now - before, 0.0)

    def _keep_time(self, elapsed: float) -> None:
        """Slow down if ticks come late, and start from rest if the arm has come to rest."""
        self._set(Condition.OVERLOADED, self._ticks.tick(elapsed))
        self.counters.late_ticks = self._ticks.late
        if elapsed > AT_REST_AFTER and self._execution is not None:
            self._execution.reference.halt()

    def _start(self, sample: JointSample) -> Execution:
        """Hold the arm exactly where it is."""
        self._law.start(sample.position)
        self._execution = Execution(self._tip, self._parameters)
        self.conditions &= ~Condition.NOT_STARTED
        return self._execution

    def _advance(self, execution: Execution, now: float, dt: float, force: Point) -> None:
        decision, freedom = decide(self.conditions), self._law.freedom
        execution.reference.paused = decision.reaction >= Reaction.SOFT_STOP
        execution.reference.pace = min(freedom.outward, freedom.dexterity, self._ticks.pace)
        stops_before = execution.reference.soft_stops
        self._finish(execution.advance(dt, self._tip))
        self.counters.soft_stops += execution.reference.soft_stops - stops_before
        (fx, fy, _), (ex, ey, _) = force, execution.error
        touch = self._contact.update(fx, fy, ex, ey)
        if self._load is not None:
            self._set(Condition.LOADED, self._load.loaded(self._contact.force))
        running = execution.running
        self._stops.moved(self._tip)
        if touch is Touch.ERROR or (touch is Touch.FORCE and running):
            self._touch(touch, running, now)
        elif not self._contact.loaded and not decision.until_reset:
            # Under load the integral would only wind up against the obstacle.
            self._law.correct(execution.error, dt)

    def _touch(self, touch: Touch, running: bool, now: float) -> None:
        self.counters.contacts += running
        self.counters.yields += not running
        values = {'force_n': self._contact.force, 'error_m': self._contact.error}
        self._react(Condition.CONTACT, ResultCode.BLOCKED, touch.value, values, self._tip)
        self._contact.disarm()
        if running and self._stops.stop(now, self._tip):
            self._fault(Condition.REPEATED)

    def _set(self, condition: Condition, there: bool) -> None:
        """Note a condition that comes and goes by itself."""
        if there != (condition in decide(self.conditions).conditions):
            self.conditions ^= condition

    def _fault(self, condition: Condition, at: Point | None = None) -> None:
        self.counters.faults += condition not in self.conditions
        place = self._tip if at is None else at
        self._react(condition, ResultCode.FAULT, decide(condition).causes[0], {}, place)

    def _distrust(self, condition: Condition) -> None:
        """Hold the command: a measurement that is not true must not move the arm."""
        self._fault(condition, at=None if self._execution is None else self._law.held)

    def _react(
        self,
        condition: Condition,
        code: ResultCode,
        reason: str,
        values: dict[str, float],
        at: Point,
    ) -> None:
        """Do what the fail-safe says about a new condition; `at` [m] is where to hold."""
        decision = decide(self.conditions | condition)
        self.conditions |= decision.latched
        if self._execution is None or decision.reaction is not Reaction.FREEZE:
            return
        self._finish(self._execution.freeze(at, code, reason, values))

    def _finish(self, finished: tuple[Finished, ...]) -> None:
        for entry in finished:
            if entry.path is None:
                self.counters.refuse(Refusal(entry.result.reason))
        self._finished.extend(finished)

    def _answer(self) -> Tick:
        finished, self._finished = tuple(self._finished), []
        return Tick(None if self._execution is None else self._law.command, finished)
