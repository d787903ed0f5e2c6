# SPDX-License-Identifier: Apache-2.0
"""Segments on their way: the reference, what the arm should show of it, the records."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from lwr_tracking.core.delay_line import DelayLine, Entry
from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.path_recorder import PathRecorder
from lwr_tracking.core.reference import Reference
from lwr_tracking.core.refusal import Refusal
from lwr_tracking.core.segment_gate import Admission
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.segment import ExecutedPath


class Finished(NamedTuple):
    """A segment that is over; without a path if it never began."""

    result: SegmentResult
    path: ExecutedPath | None


class Execution:
    """Moves the reference along accepted segments and records what the arm made of it.

    Commands run ahead of the arm by the lead time of the tracking law, so a segment is
    recorded, and over, that much later than the reference has run through it.

    Attributes:
        reference: what is commanded now.
        error: where the tip should be minus where it was last measured, x, y and z [m].

    """

    def __init__(self, tip: Sequence[float], parameters: TrackerParameters) -> None:
        """Hold the measured tip (x, y, z) [m]."""
        self.reference = Reference(tip, parameters.limits)
        self.error = (0.0, 0.0, 0.0)
        self._delay = DelayLine(parameters.law.lead)
        self._delay.fill(self._entry())
        self._expected = self._entry()
        self._recorder: PathRecorder | None = None
        self._ending: list[PathRecorder] = []

    @property
    def running(self) -> bool:
        """Tell whether the reference is on a segment."""
        return self.reference.running is not None

    def accept(self, admission: Admission) -> tuple[Finished, ...]:
        """Run an admitted segment next; return the waiting one that it replaces."""
        starts = self.reference.running is None
        replaced = self.reference.accept(admission)
        if starts:
            self._recorder = PathRecorder(admission.segment, self.reference.clock)
        return () if replaced is None else (dropped(replaced, Refusal.SUPERSEDED),)

    def advance(self, dt: float, tip: Sequence[float]) -> tuple[Finished, ...]:
        """Move on by `dt` [s], compare with the measured tip [m], return what is over."""
        ended = self.reference.advance(dt)
        if ended is not None and self._recorder is not None:
            self._ending.append(self._recorder)
            following = self.reference.running
            end, self._recorder = self._recorder.end, None
            if following is not None:
                self._recorder = PathRecorder(following.segment, end)
        self._expected = self._delay.push(dt, self._entry())
        (ex, ey, ez, _), (x, y, z) = self._expected, tip
        self.error = (ex - x, ey - y, ez - z)
        self._record(tip)
        if not self._ending:
            return ()
        finished = tuple(_done(recorder) for recorder in self._ending if recorder.complete)
        self._ending = [recorder for recorder in self._ending if not recorder.complete]
        return finished

    def freeze(
        self, tip: Sequence[float], code: ResultCode, reason: str, values: Mapping[str, float]
    ) -> tuple[Finished, ...]:
        """Hold the measured tip (x, y, z) [m] at once; end what runs, drop what waits.

        Args:
            tip: measured tip; the height of the reference stays that of the plane.
            code: how the running segment ended.
            reason: why.
            values: named figures for its result.

        """
        self._record(tip)
        x, y = float(tip[0]), float(tip[1])
        _, waiting = self.reference.freeze(x, y)
        self._delay.fill(self._entry())
        self._expected = self._entry()
        finished = [_done(recorder) for recorder in self._ending]
        if self._recorder is not None:
            segment, progress = self._recorder.segment, self._recorder.progress
            figures = {**values, 'x': x, 'y': y, 'progress': progress}
            result = SegmentResult(segment.stamp_ns, code, reason, figures)
            finished.append(Finished(result, self._recorder.executed()))
        if waiting is not None:
            refusal = Refusal.CONTACT if code is ResultCode.BLOCKED else Refusal.STOPPED
            finished.append(dropped(waiting, refusal))
        self._recorder, self._ending = None, []
        return tuple(finished)

    def _record(self, tip: Sequence[float]) -> None:
        x, y, clock = float(tip[0]), float(tip[1]), self._expected[3]
        for recorder in self._ending:
            recorder.add(clock, x, y)
        if self._recorder is not None:
            self._recorder.add(clock, x, y)

    def _entry(self) -> Entry:
        return (*self.reference.place, self.reference.clock)


def dropped(admission: Admission, refusal: Refusal) -> Finished:
    """Return the result of an accepted segment that never began."""
    stamp = admission.segment.stamp_ns
    return Finished(SegmentResult(stamp, ResultCode.REJECTED, str(refusal)), None)


def _done(recorder: PathRecorder) -> Finished:
    result = SegmentResult(recorder.segment.stamp_ns, ResultCode.DONE)
    return Finished(result, recorder.executed())
