# SPDX-License-Identifier: Apache-2.0
"""Arrays over time as JointTrajectory messages whose joints are axes of a frame."""

from array import array
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import Header
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros.mark_carrier import plain_frame
from srnn_msgs_py.ros.stamp import (
    SECOND_NS,
    duration_from_msg,
    duration_to_msg,
    stamp_from_msg,
    stamp_to_msg,
)
from srnn_msgs_py.segment import AXES

MAX_POINTS = 1000
"""More points than any plan has: longer messages are refused before they are read."""


@dataclass(frozen=True, eq=False)
class Columns:
    """A trajectory by columns.

    Attributes:
        stamp_ns: stamp of the header [ns].
        frame: frame of the header.
        times: (T,) [s].
        columns: one (T, d) array per field, by name of the field.

    """

    stamp_ns: int
    frame: str
    times: NDArray[np.float64]
    columns: dict[str, NDArray[np.float64]]


def to_msg(value: Columns) -> JointTrajectory:
    """Return a trajectory message; times are rounded to nanoseconds.

    Raises:
        MessageError: the arrays do not fit each other, or a time is no duration.

    """
    shapes = {column.shape for column in value.columns.values()}
    shape = next(iter(shapes))
    if len(shapes) != 1 or len(shape) != 2 or not 1 <= shape[1] <= len(AXES):
        raise MessageError(f'columns have the shapes {shapes}: must be one (T, 1 to {len(AXES)})')
    if value.times.shape != shape[:1] or not np.isfinite(value.times).all():
        raise MessageError(f'times {value.times!r}: must be {shape[0]} finite numbers')
    names = tuple(value.columns)
    rows = zip(*(value.columns[name].tolist() for name in names), strict=True)
    points = [
        JointTrajectoryPoint(
            time_from_start=duration_to_msg(round(time * SECOND_NS)),
            **{name: array('d', part) for name, part in zip(names, row, strict=True)},
        )
        for time, row in zip(value.times.tolist(), rows, strict=True)
    ]
    return JointTrajectory(
        header=Header(stamp=stamp_to_msg(value.stamp_ns), frame_id=str(value.frame)),
        joint_names=list(AXES[: shape[1]]),
        points=points,
    )


def from_msg(msg: JointTrajectory, fields: tuple[str, ...]) -> Columns:
    """Return a trajectory by columns; the numbers themselves are not judged.

    Args:
        msg: message to read.
        fields: fields that every point must have, for example ``positions``.

    Raises:
        MessageError: unknown axes, no or too many points, or points of unequal size.

    """
    axes = tuple(msg.joint_names)
    if not axes or axes != AXES[: len(axes)]:
        raise MessageError(f'joint_names = {list(axes)[:7]}: must be the first of {list(AXES)}')
    count = len(msg.points)
    if not 1 <= count <= MAX_POINTS:
        raise MessageError(f'{count} points: must be 1 to {MAX_POINTS}')
    return Columns(
        stamp_ns=stamp_from_msg(msg.header.stamp),
        frame=plain_frame(msg.header),
        times=_times(msg),
        columns={field: _column(msg, field, len(axes)) for field in fields},
    )


def _times(msg: JointTrajectory) -> NDArray[np.float64]:
    whole = [duration_from_msg(point.time_from_start) for point in msg.points]
    return np.array(whole, dtype=np.float64) / SECOND_NS


def _column(msg: JointTrajectory, field: str, width: int) -> NDArray[np.float64]:
    rows = [getattr(point, field) for point in msg.points]
    for index, row in enumerate(rows):
        if len(row) != width:
            raise MessageError(
                f'points[{index}].{field} has {len(row)} values: must be {width}'
            )
    return np.array(rows, dtype=np.float64)
