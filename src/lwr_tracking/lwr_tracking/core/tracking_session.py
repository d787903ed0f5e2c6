# SPDX-License-Identifier: Apache-2.0
"""All that decides in a tracker, fed by whoever hears: a node, or a replay."""

from collections import deque
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_tracking.core.failsafe import Condition, decide
from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.tracker import Tick, Tracker
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.journal import Deed, Note, unnoted
from srnn_msgs_py.result import SegmentResult
from srnn_msgs_py.segment import Segment


class TrackingSession:
    """A new tracker for each activation; what is done to it is noted before it is done.

    Attributes:
        tracker: the present one.

    """

    def __init__(
        self, parameters: TrackerParameters, kinematics: Kinematics, note: Note = unnoted
    ) -> None:
        """Compile what activation must not wait for.

        Args:
            parameters: of every tracker.
            kinematics: of the arm.
            note: keeps the journal.

        """
        self._parameters = parameters
        self._kinematics = kinematics
        self._note = note
        # The oldest command is as old as the arm is behind its commands.
        self._sent: deque[NDArray[np.float64]] = deque(
            maxlen=max(1, round(parameters.law.lead / parameters.period))
        )
        self.tracker = Tracker(parameters, kinematics)

    def begin(self, latched: Condition) -> None:
        """Be activated, stopped until reset by what had stopped a predecessor."""
        self.tracker = Tracker(self._parameters, self._kinematics)
        self.tracker.restore(latched)
        self._note(Deed.ACTIVATED, latched.value)

    def tick(self, now: float, sample: JointSample, deed: Deed = Deed.MEASURED) -> Tick:
        """Answer one measurement; the command is None where none must go out.

        Args:
            now: steady-clock time [s].
            sample: what the arm measured.
            deed: ASSUMED if it did not measure that.

        """
        self._note(deed, sample.stamp_ns, sample.lag_ns, now)
        tick = self.tracker.tick(now, sample)
        if tick.command is None:
            return tick
        # Whoever reports again after a silence may be another arm: it is told nothing yet.
        if Condition.SILENT in decide(self.tracker.conditions).conditions:
            return tick._replace(command=None)
        self._sent.append(tick.command)
        return tick

    def assumed(self, last: JointSample, stamp_ns: int) -> JointSample:
        """Return what an arm that follows its commands measures next, after `last`."""
        return replace(last, stamp_ns=stamp_ns, position=self._sent[0])

    @property
    def at_rest(self) -> bool:
        """Tell whether nothing moves, or nothing has begun."""
        reference = self.tracker.reference
        return reference is None or reference.at_rest

    def offer(self, segment: Segment, age_s: float) -> SegmentResult | None:
        """Ask for a segment; see `Tracker.offer`."""
        self._note(Deed.OFFERED, segment.stamp_ns, time_s=age_s)
        return self.tracker.offer(segment, age_s)

    def silence(self) -> None:
        """Freeze, because measurements have ceased."""
        self._note(Deed.SILENT)
        self.tracker.silence()

    def stop(self) -> None:
        """Freeze until reset."""
        self._note(Deed.STOP)
        self.tracker.stop()

    def reset(self) -> None:
        """Forget latched faults."""
        self._note(Deed.RESET)
        self.tracker.reset()

    def pause(self) -> None:
        """Come to rest on the path."""
        self._note(Deed.PAUSE)
        self.tracker.pause()

    def resume(self) -> None:
        """Run on from there."""
        self._note(Deed.RESUME)
        self.tracker.resume()
