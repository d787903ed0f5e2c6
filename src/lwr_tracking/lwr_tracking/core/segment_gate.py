# SPDX-License-Identifier: Apache-2.0
"""The gate: a pure function from a segment, and what it must join, to a verdict."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from lwr_tracking.core.blend import fade
from lwr_tracking.core.braking import braking_room
from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.quintic_path import PathState, QuinticPath
from lwr_tracking.core.refusal import Refusal
from srnn_msgs_py.segment import FRAME, Segment

Array = NDArray[np.float64]

_BETWEEN = 4
_PLANAR = 2


@dataclass(frozen=True)
class Join:
    """The state that a segment must continue.

    Attributes:
        state: reference at the moment of joining.
        late: the reference has begun to brake towards `state`, which is a rest.
        last_stamp_ns: identity of the last accepted segment [ns], None before the first.

    """

    state: PathState
    late: bool = False
    last_stamp_ns: int | None = None


@dataclass(frozen=True, eq=False)
class Admission:
    """An accepted segment, ready to run.

    Attributes:
        segment: as it was published.
        path: as it will be executed, start offset blended out.
        room: path time before the end at which a soft stop must begin [s].
        from_rest: the segment starts at rest.

    """

    segment: Segment
    path: QuinticPath
    room: float
    from_rest: bool


def judge(
    segment: Segment, join: Join, age: float, parameters: TrackerParameters
) -> Admission | Refusal:
    """Admit a segment or name the first rule that it breaks.

    Rules about the motion (workspace, speed, acceleration) are applied to the path
    that would be executed, start offset blended out, at every knot and at three
    points between any two.

    Args:
        segment: anything that arrived as a segment.
        join: what it must continue.
        age: time since it was stamped [s].
        parameters: the limits.

    """
    with np.errstate(all='ignore'):
        for refusal in _broken_form(segment, parameters):
            return refusal
        for refusal in _broken_order(segment, join, age, parameters):
            return refusal
        for refusal in _broken_join(segment, join, parameters):
            return refusal
        path = _blended(segment, join.state, parameters.gate.blend)
        for refusal in _broken_motion(path, parameters):
            return refusal
        room = braking_room(path, parameters.limits.braking)
        if not room + parameters.limits.max_step <= path.duration:
            return Refusal.NO_ROOM
    return Admission(segment, path, room, from_rest=join.state.at_rest)


def _broken_form(segment: Segment, parameters: TrackerParameters) -> Iterator[Refusal]:
    gate = parameters.gate
    times = segment.times
    motion = (segment.positions, segment.velocities, segment.accelerations)
    if segment.frame != FRAME:
        yield Refusal.FRAME
    if times.ndim != 1 or any(m.shape != (times.shape[0], _PLANAR) for m in motion):
        yield Refusal.SHAPE
    if not 2 <= times.shape[0] <= gate.max_knots:
        yield Refusal.KNOTS
    if not all(np.isfinite(array).all() for array in (times, *motion)):
        yield Refusal.NOT_FINITE
    if times[0] != 0.0 or not np.diff(times).min() >= gate.min_step:
        yield Refusal.TIMES


def _broken_order(
    segment: Segment, join: Join, age: float, parameters: TrackerParameters
) -> Iterator[Refusal]:
    last = join.last_stamp_ns
    if last is not None and segment.stamp_ns == last:
        yield Refusal.DUPLICATE
    if last is not None and segment.stamp_ns < last:
        yield Refusal.OUT_OF_ORDER
    if not (isfinite(age) and age <= parameters.gate.max_age):
        yield Refusal.STALE


def _broken_join(
    segment: Segment, join: Join, parameters: TrackerParameters
) -> Iterator[Refusal]:
    gate, state = parameters.gate, join.state
    x, y = segment.positions[0].tolist()
    vx, vy = segment.velocities[0].tolist()
    if not np.hypot(x - state.x, y - state.y) <= gate.start_distance:
        yield Refusal.START_POSITION
    if not np.hypot(vx - state.vx, vy - state.vy) <= gate.acceleration_limit * parameters.period:
        yield Refusal.LATE if join.late else Refusal.START_VELOCITY


def _broken_motion(path: QuinticPath, parameters: TrackerParameters) -> Iterator[Refusal]:
    gate = parameters.gate
    share = np.arange(_BETWEEN) / _BETWEEN
    step = np.diff(path.times)
    inner = (path.times[:-1, None] + step[:, None] * share).ravel()
    p, v, a = path.evaluate(np.append(inner, path.duration))
    knots = p[::_BETWEEN]
    if not np.abs(p).max() <= gate.half_width - gate.margin:
        yield Refusal.OUTSIDE
    if not np.hypot(*np.diff(knots, axis=0).T / step).max() <= gate.speed_limit:
        yield Refusal.JUMP
    if not np.hypot(v[:, 0], v[:, 1]).max() <= gate.speed_limit:
        yield Refusal.SPEED
    if not np.hypot(a[:, 0], a[:, 1]).max() <= gate.acceleration_limit:
        yield Refusal.ACCELERATION


def _blended(segment: Segment, state: PathState, span: float) -> QuinticPath:
    """Return the path of a segment that starts in `state` and fades to the knots."""
    offset = np.array((state.x, state.y)) - segment.positions[0]
    slope = np.array((state.vx, state.vy)) - segment.velocities[0]
    p, v, a = fade(segment.times, offset, slope, min(span, segment.duration))
    return QuinticPath(
        segment.times,
        segment.positions + p,
        segment.velocities + v,
        segment.accelerations + a,
    )
