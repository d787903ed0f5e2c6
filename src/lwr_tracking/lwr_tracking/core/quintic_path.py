# SPDX-License-Identifier: Apache-2.0
"""A planar path through knots: quintic Hermite interpolation, C2 at every knot."""

from bisect import bisect_right
from math import hypot
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lwr_tracking.core.errors import PathError

Array = NDArray[np.float64]


REST_SPEED = 1e-3
"""What moves slower counts as resting [m/s]."""


class PathState(NamedTuple):
    """Position [m] and velocity [m/s] of a point in the plane, in `srnn_workspace`."""

    x: float
    y: float
    vx: float = 0.0
    vy: float = 0.0

    @property
    def speed(self) -> float:
        """Magnitude of the velocity [m/s]."""
        return hypot(self.vx, self.vy)

    @property
    def at_rest(self) -> bool:
        """Tell whether the point does not move."""
        return self.speed < REST_SPEED


class QuinticPath:
    """Quintic Hermite spline: meets position, velocity and acceleration of each knot.

    Attributes:
        times: (T,) path times of the knots [s].
        duration: path time of the last knot [s].
        peak_speed: largest speed at a knot [m/s].
        end: state at the last knot.

    """

    def __init__(
        self, times: Array, positions: Array, velocities: Array, accelerations: Array
    ) -> None:
        """Lay the path through the knots.

        Args:
            times: (T,) path times [s], times[0] = 0, increasing.
            positions: (T, 2) [m].
            velocities: (T, 2) [m/s].
            accelerations: (T, 2) [m/s^2].

        Raises:
            PathError: the shapes disagree or the times do not increase from 0.

        """
        knots = times.shape[0] if times.ndim == 1 else 0
        shapes = {positions.shape, velocities.shape, accelerations.shape}
        if knots < 2 or shapes != {(knots, 2)}:
            raise PathError(f'knots of shapes {times.shape}, {shapes}: must be (T,) and (T, 2)')
        step = np.diff(times)
        if times[0] != 0.0 or not np.all(step > 0.0):
            raise PathError('times: must increase strictly from 0')
        self.times = times
        self.duration = float(times[-1])
        self.peak_speed = float(np.hypot(velocities[:, 0], velocities[:, 1]).max())
        self.end = PathState(*positions[-1].tolist(), *velocities[-1].tolist())
        self._knots: list[float] = times.tolist()
        self._step = step
        self._coefficients = _coefficients(step[:, None], positions, velocities, accelerations)
        self._rows: list[list[float]] = self._coefficients.reshape(knots - 1, -1).tolist()

    def place(self, time: float) -> tuple[float, float]:
        """Return x and y of `state` [m]."""
        (a0, b0, a1, b1, a2, b2, a3, b3, a4, b4, a5, b5), u, _ = self._at(time)
        return (
            a0 + u * (a1 + u * (a2 + u * (a3 + u * (a4 + u * a5)))),
            b0 + u * (b1 + u * (b2 + u * (b3 + u * (b4 + u * b5)))),
        )

    def state(self, time: float) -> PathState:
        """Return the point at a path time [s], held before the start and after the end."""
        (_, _, a1, b1, a2, b2, a3, b3, a4, b4, a5, b5), u, h = self._at(time)
        return PathState(
            *self.place(time),
            (a1 + u * (2 * a2 + u * (3 * a3 + u * (4 * a4 + u * 5 * a5)))) / h,
            (b1 + u * (2 * b2 + u * (3 * b3 + u * (4 * b4 + u * 5 * b5)))) / h,
        )

    def _at(self, time: float) -> tuple[list[float], float, float]:
        """Return the coefficients of an interval, the time in it, 0 to 1, and its length [s]."""
        knots = self._knots
        if not 0.0 <= time <= self.duration:
            time = 0.0 if time < 0.0 else self.duration
        i = min(bisect_right(knots, time), len(self._rows)) - 1
        h = knots[i + 1] - knots[i]
        return self._rows[i], (time - knots[i]) / h, h

    def evaluate(self, times: Array) -> tuple[Array, Array, Array]:
        """Return positions, velocities and accelerations, (n, 2) each, at path times (n,)."""
        i = np.clip(np.searchsorted(self.times, times, side='right') - 1, 0, len(self._step) - 1)
        h = self._step[i, None]
        u = (times - self.times[i])[:, None] / h
        c0, c1, c2, c3, c4, c5 = np.moveaxis(self._coefficients[i], 1, 0)
        p = c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5))))
        v = (c1 + u * (2 * c2 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / h
        a = (2 * c2 + u * (6 * c3 + u * (12 * c4 + u * 20 * c5))) / h**2
        return p, v, a


def _coefficients(h: Array, p: Array, v: Array, a: Array) -> Array:
    """Return (T-1, 6, 2) polynomial coefficients in the normalised time of each interval."""
    dp = p[1:] - p[:-1] - h * v[:-1] - 0.5 * h**2 * a[:-1]
    dv = h * (v[1:] - v[:-1] - h * a[:-1])
    da = h**2 * (a[1:] - a[:-1])
    return np.stack(
        (
            p[:-1],
            h * v[:-1],
            0.5 * h**2 * a[:-1],
            10.0 * dp - 4.0 * dv + 0.5 * da,
            -15.0 * dp + 7.0 * dv - da,
            6.0 * dp - 3.0 * dv + 0.5 * da,
        ),
        axis=1,
    )
