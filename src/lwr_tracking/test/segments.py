# SPDX-License-Identifier: Apache-2.0
"""Smooth chains of segments for tests: constant speed along a spline, joined C1."""

from collections.abc import Sequence
import dataclasses
from itertools import pairwise

import numpy as np
from spline import Spline

from srnn_msgs_py.segment import Segment

MS = 1_000_000
RAMP = 0.3
"""Time in which a chain that starts or ends at rest changes its speed [s]."""


def chain(
    points: Sequence[tuple[float, float]],
    speed: float,
    duration: float = 1.0,
    knots: int = 30,
    first_stamp: int = MS,
    stop: bool = True,
) -> list[Segment]:
    """Return segments along the spline through `points`, the first one from rest.

    Args:
        points: way points of the spline [m]; it passes them all.
        speed: along the spline, but for the ramps [m/s].
        duration: of each segment, about [s].
        knots: per segment.
        first_stamp: identity of the first segment, those after it follow [ns].
        stop: the last segment ends at rest.

    """
    along = _by_arc_length(np.array(points, dtype=float))
    length = float(along.x[-1])
    rest = RAMP * (1.0 + stop) / 2.0
    total = length / speed + rest
    count = max(round(total / duration), 1)
    edges = np.linspace(0.0, total, count + 1)
    return [
        _segment(along, speed, total, stop, np.linspace(a, b, knots), first_stamp + i * MS)
        for i, (a, b) in enumerate(pairwise(edges))
    ]


def line(
    start: tuple[float, float], end: tuple[float, float], speed: float, stamp_ns: int = MS,
    stop: bool = True,
) -> Segment:
    """Return one straight segment from rest, ending at rest or at speed."""
    duration = float(np.hypot(end[0] - start[0], end[1] - start[1])) / speed + RAMP
    return chain((start, end), speed, 10.0 * duration, first_stamp=stamp_ns, stop=stop)[0]


def replaced(segment: Segment, **changes: object) -> Segment:
    """Return a copy of a segment with other fields."""
    return dataclasses.replace(segment, **changes)


def _by_arc_length(points: np.ndarray) -> Spline:
    if len(points) == 2:
        return Spline([0.0, float(np.linalg.norm(points[1] - points[0]))], points)
    closed = bool(np.all(points[0] == points[-1]))
    chord = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
    curve = Spline(chord, points, periodic=closed)
    fine = np.linspace(0.0, chord[-1], 1000 * len(points))
    steps = np.linalg.norm(np.diff(curve(fine), axis=0), axis=1)
    arc = np.append(0.0, np.cumsum(steps))
    even = np.linspace(0.0, arc[-1], 100 * len(points))
    return Spline(even, curve(np.interp(even, arc, fine)))


def _segment(
    along: Spline, speed: float, total: float, stop: bool, time: np.ndarray, stamp_ns: int
) -> Segment:
    s, v, a = _ramped(time, speed)
    if stop:
        left, end_speed, end_slowing = _ramped(total - time, speed)
        near_end = time > total / 2.0
        s = np.where(near_end, float(along.x[-1]) - left, s)
        v = np.where(near_end, end_speed, v)
        a = np.where(near_end, -end_slowing, a)
    tangent = along(s, 1)
    return Segment(
        stamp_ns,
        time - time[0],
        along(s),
        tangent * v[:, None],
        along(s, 2) * v[:, None] ** 2 + tangent * a[:, None],
    )


def _ramped(time: np.ndarray, speed: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return arc length, speed and acceleration of a smooth start from rest."""
    u = np.clip(time / RAMP, 0.0, 1.0)
    s = speed * (RAMP * (u**3 - 0.5 * u**4) + np.maximum(time - RAMP, 0.0))
    return s, speed * (3.0 * u**2 - 2.0 * u**3), speed * 6.0 * u * (1.0 - u) / RAMP
