# SPDX-License-Identifier: Apache-2.0
"""Backing off after a contact, along the path that has just been travelled."""

from collections import deque

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.trajectory import Motion, Trajectory

_KNOTS = 8


class Trail:
    """The last measured positions of the arm, so that it can go back where it came from."""

    def __init__(self, points: int = 1000) -> None:
        """Remember at most `points` positions."""
        self._points: deque[NDArray[np.float64]] = deque(maxlen=points)

    def extend(self, positions: NDArray[np.float64]) -> None:
        """Append measured positions (n, d) [m] in the order they were passed."""
        self._points.extend(np.array(positions))

    def back(self, distance: float) -> NDArray[np.float64]:
        """Return the latest position (d,) at least `distance` metres from the last one.

        Distance as the crow flies: after several contacts in a row the path itself goes
        to and fro. The farthest position where none is far enough.

        Raises:
            ValueError: nothing was travelled yet.

        """
        if not self._points:
            raise ValueError('no path to go back on')
        points = np.array(self._points)
        away = np.linalg.norm(points - points[-1], axis=1)
        far = np.flatnonzero(away >= distance)
        return np.asarray(points[far[-1] if len(far) else np.argmax(away)])


def back_off(
    contact: NDArray[np.float64], onward: Trajectory, acceleration: float
) -> Trajectory:
    """Put a straight retreat, from rest to rest, before a trajectory that starts at rest.

    Args:
        contact: (d,) where the arm has stopped [m].
        onward: trajectory from the point to retreat to.
        acceleration: constant acceleration, then deceleration [m/s^2].

    """
    target = onward.positions[0]
    distance = float(np.linalg.norm(target - contact))
    if distance < 1e-6:
        return onward
    half = float(np.sqrt(distance / acceleration))
    t = np.linspace(0.0, 2.0 * half, _KNOTS + 1)[:-1]
    left = 2.0 * half - t
    leaving = t < half
    travelled = np.where(leaving, 0.5 * acceleration * t**2,
                         distance - 0.5 * acceleration * left**2)
    speed = acceleration * np.where(leaving, t, left)
    rate = np.where(leaving, acceleration, -acceleration)
    direction = (target - contact) / distance
    return Trajectory(
        times=np.concatenate([t, 2.0 * half + onward.times]),
        positions=np.vstack([contact + travelled[:, None] * direction, onward.positions]),
        velocities=np.vstack([speed[:, None] * direction, onward.velocities]),
        accelerations=np.vstack([rate[:, None] * direction, onward.accelerations]),
    )


def at_rest(position: NDArray[np.float64]) -> Motion:
    """Return the state of standing still at `position` (d,) [m]."""
    return Motion(position, np.zeros_like(position))
