# SPDX-License-Identifier: Apache-2.0
"""The reference of the tip: a chain of accepted segments, or a point held at rest."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lwr_tracking.core.parameters import LimitParameters
from lwr_tracking.core.path_time import PathTime
from lwr_tracking.core.quintic_path import REST_SPEED, PathState
from lwr_tracking.core.segment_gate import Admission

Array = NDArray[np.float64]

_PEAK = 1.875


class Reference:
    """Runs one segment after the other and never leaves an accepted path.

    Attributes:
        running: the segment being executed, None while a point is held.
        waiting: the segment that continues it, None if there is none.
        clock: path time run through since the start, all segments together [s].
        place: x, y and z in `srnn_workspace` [m].
        paused: brake along the path and stand still.
        pace: share of its speed that the arm can follow now, 0 to 1.
        soft_stops: segments that ended in a soft stop because nothing continued them.

    """

    def __init__(self, place: Sequence[float], limits: LimitParameters) -> None:
        """Hold a point (x, y, z) [m] in the plane; approach height 0 gently from its z."""
        self.running: Admission | None = None
        self.waiting: Admission | None = None
        self.clock = 0.0
        self.paused = False
        self.pace = 1.0
        self.soft_stops = 0
        x, y, z = map(float, place)
        self.place = (x, y, z)
        self._held = PathState(x, y)
        self._limits = limits
        self._time: PathTime | None = None
        self._height = z
        self._rise = 0.0
        self._height_time = 0.0
        self._height_span = _PEAK * abs(self._height) / limits.height_speed

    @property
    def position(self) -> Array:
        """Return the point (3,) in `srnn_workspace` [m]."""
        return np.array(self.place)

    @property
    def velocity(self) -> Array:
        """Return how fast it moves, (3,) [m/s]."""
        if self.running is None or self._time is None:
            return np.array((0.0, 0.0, self._rise))
        state, rate = self.running.path.state(self._time.value), self._time.rate
        return np.array((rate * state.vx, rate * state.vy, self._rise))

    @property
    def at_rest(self) -> bool:
        """Tell whether the reference stands still in the plane, also in mid-path."""
        return self._time is None or self._time.rate == 0.0

    def join(self) -> tuple[PathState, bool]:
        """Return the state that the next segment must continue, and whether it is late."""
        if self.running is None or self._time is None:
            return self._held, False
        path = self.running.path
        if self._time.rate == 1.0 and not self._time.braking:
            return path.end, False
        return PathState(path.end.x, path.end.y), self._time.braking

    def accept(self, admission: Admission) -> Admission | None:
        """Run an admitted segment next; return the waiting one that it replaces."""
        if self.running is None:
            self._begin(admission, rate=1.0, value=0.0)
            return None
        replaced, self.waiting = self.waiting, admission
        return replaced

    def advance(self, dt: float) -> Admission | None:
        """Move on by `dt` [s]; return the segment that came to its end, if one did."""
        ended = self._advance_path(self.pace * dt)
        if self.running is None or self._time is None:
            x, y, _, _ = self._held
        else:
            x, y = self.running.path.place(self._time.value)
        self.place = (x, y, self._advance_height(self.pace * dt))
        return ended

    def halt(self) -> None:
        """Begin anew from rest where the reference is, because the arm has come to rest there."""
        if self._time is not None and not self._time.braking:
            self._time.rate = 0.0

    def freeze(self, x: float, y: float) -> tuple[Admission | None, Admission | None]:
        """Hold a point at once [m]; return the running and the waiting segment, dropped."""
        dropped = self.running, self.waiting
        self.running = self.waiting = self._time = None
        self._held = PathState(x, y)
        self.place = (x, y, self.place[2])
        return dropped

    def _advance_path(self, dt: float) -> Admission | None:
        if self.running is None or self._time is None:
            return None
        following = self.waiting
        path = self.running.path
        stops = following is None or (following.from_rest and not path.end.at_rest)
        before = self._time.value
        over = self._time.advance(dt, stops, self.paused)
        self.clock += self._time.value - before
        if not self._time.finished:
            return None
        ended, rate = self.running, self._time.rate
        self.soft_stops += self._time.braking
        if stops:
            rate = 0.0 if self.paused else 1.0
        self.running = self.waiting = self._time = None
        self._held = PathState(path.end.x, path.end.y)
        if following is not None:
            self._begin(following, rate, over)
        return ended

    def _begin(self, admission: Admission, rate: float, value: float) -> None:
        """Start a segment `value` seconds of path time after its first knot."""
        path = admission.path
        ramp = self._limits.braking / max(path.peak_speed, REST_SPEED)
        self.running = admission
        self._time = PathTime(path.duration, admission.room, ramp, rate)
        self._time.value = value
        self.clock += value

    def _advance_height(self, dt: float) -> float:
        """Bring the height to 0 along a minimum-jerk curve; return it [m]."""
        if self._height_time >= self._height_span:
            self._rise = 0.0
            return 0.0
        self._height_time = min(self._height_time + dt, self._height_span)
        u = self._height_time / self._height_span
        self._rise = -self._height * 30.0 * u * u * (1.0 - u) ** 2 / self._height_span
        return self._height * (1.0 - u**3 * (10.0 - 15.0 * u + 6.0 * u * u))
