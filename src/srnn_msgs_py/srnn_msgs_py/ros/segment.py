# SPDX-License-Identifier: Apache-2.0
"""Segment ↔ trajectory_msgs/JointTrajectory."""

from trajectory_msgs.msg import JointTrajectory

from srnn_msgs_py.ros import trajectory
from srnn_msgs_py.segment import Segment

_FIELDS = ('positions', 'velocities', 'accelerations')


def to_msg(segment: Segment) -> JointTrajectory:
    """Return the message of a segment; times are rounded to nanoseconds.

    Raises:
        MessageError: the arrays do not fit each other, or a time is no duration.

    """
    columns = {field: getattr(segment, field) for field in _FIELDS}
    return trajectory.to_msg(
        trajectory.Columns(segment.stamp_ns, segment.frame, segment.times, columns)
    )


def from_msg(msg: JointTrajectory) -> Segment:
    """Return the segment of a message; whether it may be executed is the gate's business.

    Raises:
        MessageError: unknown axes, no or too many points, or points of unequal size.

    """
    value = trajectory.from_msg(msg, _FIELDS)
    return Segment(value.stamp_ns, value.times, **value.columns, frame=value.frame)
