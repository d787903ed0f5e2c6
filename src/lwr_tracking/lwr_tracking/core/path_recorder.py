# SPDX-License-Identifier: Apache-2.0
"""The measured path of one segment, at the times of its plan."""

import numpy as np

from srnn_msgs_py.segment import ExecutedPath, Segment

_ROUNDING = 1e-9
"""What summing up time steps may lose [s]."""


class PathRecorder:
    """Collects measured tips against the path clock; what comes last is held."""

    def __init__(self, segment: Segment, start: float) -> None:
        """Record `segment`, whose first knot is passed at path clock `start` [s]."""
        self.segment = segment
        self._start = start
        self._clock: list[float] = []
        self._x: list[float] = []
        self._y: list[float] = []

    def add(self, clock: float, x: float, y: float) -> None:
        """Add the tip [m] measured when it should have been at path clock `clock` [s]."""
        if self._clock and (clock <= self._clock[-1] or clock <= self._start):
            # Standing still, or not yet begun: only the newest measurement counts.
            self._clock.pop()
            self._x.pop()
            self._y.pop()
        self._clock.append(clock)
        self._x.append(x)
        self._y.append(y)

    @property
    def end(self) -> float:
        """Path clock at which the last knot is passed [s]."""
        return self._start + self.segment.duration

    @property
    def complete(self) -> bool:
        """Tell whether the last knot has been passed."""
        return bool(self._clock) and self._clock[-1] >= self.end - _ROUNDING

    @property
    def progress(self) -> float:
        """Share of the segment that has been passed, 0 to 1."""
        passed = self._clock[-1] - self._start if self._clock else 0.0
        return min(max(passed / self.segment.duration, 0.0), 1.0)

    def executed(self) -> ExecutedPath:
        """Return the measured path, held after the last measurement.

        Needs at least one measurement.
        """
        times = self.segment.times
        clock = self._start + times
        positions = np.column_stack(
            (np.interp(clock, self._clock, self._x), np.interp(clock, self._clock, self._y))
        )
        return ExecutedPath(self.segment.stamp_ns, times, positions)
