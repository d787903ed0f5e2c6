# SPDX-License-Identifier: Apache-2.0
"""Path time of one segment: runs at rate 1, pauses, brakes to rest exactly at the end."""


class PathTime:
    """Where on a path the reference is, and how fast path time runs.

    Attributes:
        value: path time [s].
        rate: path time per time, 0 to 1.
        braking: the soft stop at the end has begun and cannot be taken back.

    """

    def __init__(self, duration: float, room: float, ramp: float, rate: float = 1.0) -> None:
        """Start at path time 0.

        Args:
            duration: path time of the end [s].
            room: path time before the end at which braking from rate 1 must begin [s].
            ramp: fastest change of the rate for a pause [1/s].
            rate: rate to start with.

        """
        self.value = 0.0
        self.rate = rate
        self.braking = False
        self._duration = duration
        self._room = room
        self._ramp = ramp
        self._brake_left = 0.0
        self._brake_rate = 0.0
        self._brake_time = 0.0

    def advance(self, dt: float, stop_at_end: bool, paused: bool) -> float:
        """Move on by a time and return the path time left over after the end [s].

        Args:
            dt: time that has passed [s].
            stop_at_end: nothing continues the motion after the end.
            paused: slow down and stand still instead.

        """
        if not self.braking:
            rate = self.rate + (-self._ramp * dt if paused else self._ramp * dt)
            rate = 0.0 if rate < 0.0 else min(rate, 1.0)
            step = 0.5 * (self.rate + rate) * dt
            left = self._duration - self.value
            # Braking one tick early is gentler than the limit, one tick late is harder.
            brake = stop_at_end and self._room > 0.0 and left - step < rate * rate * self._room
            if not brake:
                return self._run_to(self.value + step, rate, stop_at_end)
            self.braking = True
            self._brake_left = left
            self._brake_rate = max(self.rate, self._ramp * dt)
        return self._brake(dt)

    @property
    def finished(self) -> bool:
        """Tell whether the end has been reached."""
        return self.value >= self._duration

    def _run_to(self, value: float, rate: float, stop_at_end: bool) -> float:
        self.rate = rate
        over = max(value - self._duration, 0.0)
        self.value = min(value, self._duration)
        return 0.0 if stop_at_end else over

    def _brake(self, dt: float) -> float:
        """Follow the parabola of path time whose apex is the end."""
        self._brake_time += dt
        share = 1.0 - self._brake_time * self._brake_rate / (2.0 * self._brake_left)
        share = max(share, 0.0)
        self.rate = self._brake_rate * share
        self.value = self._duration - self._brake_left * share * share
        return 0.0
