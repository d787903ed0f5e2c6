# SPDX-License-Identifier: Apache-2.0
"""ExecutedPath ↔ trajectory_msgs/JointTrajectory with positions only."""

from trajectory_msgs.msg import JointTrajectory

from srnn_msgs_py.ros import trajectory
from srnn_msgs_py.ros.arrays import require_finite
from srnn_msgs_py.segment import ExecutedPath


def to_msg(path: ExecutedPath) -> JointTrajectory:
    """Return the message of a measured path; times are rounded to nanoseconds.

    Raises:
        MessageError: the arrays do not fit each other, or a time is no duration.

    """
    return trajectory.to_msg(
        trajectory.Columns(path.stamp_ns, path.frame, path.times, {'positions': path.positions})
    )


def from_msg(msg: JointTrajectory) -> ExecutedPath:
    """Return the measured path of a message.

    Raises:
        MessageError: unknown axes, no or too many points, points of unequal size, or
            a number that is not finite.

    """
    value = trajectory.from_msg(msg, ('positions',))
    positions = value.columns['positions']
    require_finite(positions, 'positions')
    return ExecutedPath(value.stamp_ns, value.times, positions, frame=value.frame)
