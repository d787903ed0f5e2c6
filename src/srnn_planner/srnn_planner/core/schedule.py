# SPDX-License-Identifier: Apache-2.0
"""When to start planning: as late as the measured planning times allow."""

from collections import deque
from statistics import fmean, pstdev

from srnn_planner.core.parameters import ScheduleParameters


class PlanningSchedule:
    """Running mean and deviation of the planning time.

    Planning starts mean + 3 sigma, plus a margin for transport, before the running
    segment is expected to end (Tanneberg et al. 2019, "Online Motion Planning
    Framework").
    """

    def __init__(self, parameters: ScheduleParameters) -> None:
        """Start with the assumed planning time."""
        self._parameters = parameters
        self._times: deque[float] = deque(maxlen=parameters.window)
        self._expected = parameters.initial

    def record(self, seconds: float) -> None:
        """Take in the measured planning time of a segment [s]."""
        self._times.append(seconds)
        if len(self._times) > 1:
            self._expected = fmean(self._times) + 3.0 * pstdev(self._times)

    @property
    def lead(self) -> float:
        """Time before the expected end of a segment at which to plan the next [s]."""
        return self._expected + self._parameters.margin

    def start(self, segment_start: float, duration: float) -> float:
        """Return the time at which to plan the successor of a segment [s]."""
        return segment_start + max(0.0, duration - self.lead)
