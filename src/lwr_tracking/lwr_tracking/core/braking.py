# SPDX-License-Identifier: Apache-2.0
"""How much path time a soft stop needs before the end of a path."""

import numpy as np

from lwr_tracking.core.quintic_path import REST_SPEED, QuinticPath

_CANDIDATES = 32
_POINTS = 9


def braking_room(path: QuinticPath, limit: float) -> float:
    """Return the path time before the end at which a soft stop must begin.

    The rate of path time falls linearly from 1 to 0, so the path time left is
    R f^2 while the rate is f, and the tip decelerates by v / (2 R) - f^2 a_t, with
    v and a_t the planned speed and tangential acceleration. The result is the
    smallest R that keeps this below `limit`, or below what the plan itself does.

    Args:
        path: the accepted path.
        limit: largest deceleration [m/s^2].

    Returns:
        Path time R [s]; 0 if the path ends at rest, infinite if no R fits.

    """
    if path.end.at_rest:
        return 0.0
    room = path.peak_speed / limit * np.arange(1, _CANDIDATES + 1) / _CANDIDATES
    room = room[room <= path.duration]
    if room.size == 0:
        return float('inf')
    rate = np.linspace(0.0, 1.0, _POINTS)
    times = path.duration - room[:, None] * rate**2
    _, v, a = path.evaluate(times.ravel())
    speed = np.hypot(v[:, 0], v[:, 1])
    tangential = (np.sum(v * a, axis=1) / np.maximum(speed, REST_SPEED)).reshape(times.shape)
    stop = speed.reshape(times.shape) / (2.0 * room[:, None]) - rate**2 * tangential
    allowed = np.maximum(limit, (-tangential).max(axis=1)) * (1.0 + 1e-9)
    fits = np.flatnonzero(stop.max(axis=1) <= allowed)
    return float(room[fits[0]]) if fits.size else float('inf')
