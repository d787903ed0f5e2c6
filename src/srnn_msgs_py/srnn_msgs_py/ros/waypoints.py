# SPDX-License-Identifier: Apache-2.0
"""Waypoints ↔ geometry_msgs/PoseArray; orientations carry no meaning."""

from geometry_msgs.msg import PoseArray
import numpy as np
from std_msgs.msg import Header

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros.points import pose_at, xyz
from srnn_msgs_py.ros.stamp import stamp_from_msg, stamp_to_msg
from srnn_msgs_py.waypoints import Waypoints

MAX_WAYPOINTS = 100


def to_msg(waypoints: Waypoints) -> PoseArray:
    """Return the message of a tour."""
    return PoseArray(
        header=Header(stamp=stamp_to_msg(waypoints.stamp_ns), frame_id=str(waypoints.frame)),
        poses=[pose_at(point) for point in waypoints.points],
    )


def from_msg(msg: PoseArray) -> Waypoints:
    """Return the tour of a message.

    Raises:
        MessageError: there is no point, there are too many, or one is not finite.

    """
    count = len(msg.poses)
    if not 1 <= count <= MAX_WAYPOINTS:
        raise MessageError(f'{count} poses: must be 1 to {MAX_WAYPOINTS}')
    points = [xyz(pose.position, f'poses[{i}].position') for i, pose in enumerate(msg.poses)]
    return Waypoints(
        stamp_from_msg(msg.header.stamp), np.array(points), str(msg.header.frame_id)
    )
