# SPDX-License-Identifier: Apache-2.0
"""A path in space into a segment in time that joins the arm's motion smoothly."""

from dataclasses import dataclass
from functools import lru_cache
import math

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.curve import Curve, fit
from srnn_planner.core.parameters import TrajectoryParameters


@dataclass(frozen=True, eq=False)
class Motion:
    """State of the reference where a segment begins.

    Attributes:
        position: (d,) [m].
        velocity: (d,) [m/s].

    """

    position: NDArray[np.float64]
    velocity: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Knots of a segment: (T,) times [s] and (T, d) positions [m] with derivatives."""

    times: NDArray[np.float64]
    positions: NDArray[np.float64]
    velocities: NDArray[np.float64]
    accelerations: NDArray[np.float64]

    @property
    def duration(self) -> float:
        """Execution time [s]."""
        return float(self.times[-1])

    @property
    def end(self) -> Motion:
        """State in which the segment ends."""
        return Motion(self.positions[-1], self.velocities[-1])


def join(
    path: NDArray[np.float64], start: NDArray[np.float64], blend_steps: float
) -> NDArray[np.float64]:
    """Return the path (T, d) with its offset to `start` (d,) blended out over its steps."""
    return np.asarray(path + _decay(len(path), blend_steps) * (start - path[0]))


@lru_cache(maxsize=8)
def _decay(steps: int, blend_steps: float) -> NDArray[np.float64]:
    return np.asarray(np.exp(-np.arange(steps) / blend_steps)[:, None])


def time_path(
    path: NDArray[np.float64], start: Motion, velocity: float, parameters: TrajectoryParameters
) -> Trajectory | None:
    """Give a path a duration and a velocity that continues the arm's motion.

    The execution time is length over velocity (Tanneberg et al. 2019, "Online Motion
    Planning Framework"), plus what starting, turning and changing speed need.

    Args:
        path: (T, d) averaged positions [m]; its offset to `start` is blended out.
        start: state that the segment continues.
        velocity: speed to reach [m/s].
        parameters: blending and acceleration limits.

    Returns:
        T knots, or None if no speed keeps the acceleration limit.

    """
    curve = fit(join(path, start.position, parameters.blend_steps))
    for attempt in range(20):
        caution = 0.8**attempt
        trajectory = _at_speed(curve, len(path), start, velocity, caution, parameters)
        peak = np.sqrt((trajectory.accelerations**2).sum(axis=1).max())
        if peak <= parameters.acceleration_max:
            return trajectory
    return None


def _at_speed(
    curve: Curve,
    knots: int,
    start: Motion,
    velocity: float,
    caution: float,
    p: TrajectoryParameters,
) -> Trajectory:
    """Follow the curve at `caution` times the wanted speed, and as much more gently."""
    acceleration = max(caution, 0.5) * p.acceleration
    length = max(curve.length, 1e-6)
    speed = min(caution * velocity, length / p.duration_min)
    tangent = curve.coefficients[1] / length
    # Faster than this cannot be slowed down within the path; the turn takes the rest.
    fastest = math.sqrt(speed**2 + acceleration * length)
    first = min(max(caution * float(start.velocity @ tangent), 0.0), fastest)
    ramp = abs(speed - first) / acceleration
    ramp_length = 0.5 * (speed + first) * ramp
    if ramp_length > 0.8 * length:
        # Too short to reach the speed: one ramp over the whole segment.
        ramp = 2.0 * length / (speed + first)
        ramp_length = length
    duration = ramp + (length - ramp_length) / speed
    t = duration * _shares(knots)
    s, s_dot, s_ddot = _profile(t, first, speed, ramp, length)
    positions, d1, d2 = curve.at(s)
    velocities = d1 * s_dot[:, None]
    accelerations = d2 * s_dot[:, None] ** 2 + d1 * s_ddot[:, None]
    turn = start.velocity - velocities[0]
    h, h_dot, h_ddot = _turn_blend(t, math.sqrt(float(turn @ turn)), duration, acceleration)
    return Trajectory(
        times=t,
        positions=positions + h[:, None] * turn,
        velocities=velocities + h_dot[:, None] * turn,
        accelerations=accelerations + h_ddot[:, None] * turn,
    )


@lru_cache(maxsize=8)
def _shares(knots: int) -> NDArray[np.float64]:
    return np.linspace(0.0, 1.0, knots)


def _profile(
    t: NDArray[np.float64], first: float, speed: float, ramp: float, length: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Curve parameter and its derivatives: a linear ramp of speed, then constant speed."""
    rate = (speed - first) / ramp if ramp > 0.0 else 0.0
    ramping = t < ramp
    until = np.minimum(t, ramp)
    distance = first * until + 0.5 * rate * until**2 + speed * (t - until)
    velocity = np.where(ramping, first + rate * t, speed)
    return distance / length, velocity / length, np.where(ramping, rate, 0.0) / length


def _turn_blend(
    t: NDArray[np.float64], change: float, duration: float, acceleration: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Blend h(t) = t (1 - t/b)^2 with h(0) = 0, h'(0) = 1, gone with h' at b."""
    b = min(duration, max(0.1, 4.0 * change / acceleration))
    ratio = t / b
    x = np.maximum(1.0 - ratio, 0.0)
    return t * x**2, x**2 - 2.0 * ratio * x, np.where(x > 0.0, (6.0 * ratio - 4.0) / b, 0.0)
