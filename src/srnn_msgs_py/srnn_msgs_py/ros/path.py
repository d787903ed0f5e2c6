# SPDX-License-Identifier: Apache-2.0
"""Segments and executed paths → nav_msgs/Path → positions, for display only.

An array of messages costs milliseconds to read in Python: no process that moves the
arm may subscribe to one.
"""

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import Header

from srnn_msgs_py.ros.points import pose_at
from srnn_msgs_py.ros.stamp import SECOND_NS, stamp_to_msg
from srnn_msgs_py.segment import ExecutedPath, Segment


def to_msg(path: Segment | ExecutedPath) -> Path:
    """Return the path; every pose is stamped with the time at which it is due."""
    frame = str(path.frame)
    poses = []
    for time, position in zip(path.times.tolist(), path.positions, strict=True):
        stamp = stamp_to_msg(path.stamp_ns + round(time * SECOND_NS))
        header = Header(stamp=stamp, frame_id=frame)
        poses.append(PoseStamped(header=header, pose=pose_at(position)))
    return Path(header=Header(stamp=stamp_to_msg(path.stamp_ns), frame_id=frame), poses=poses)


def positions(msg: Path) -> NDArray[np.float64]:
    """Return the positions (n, 3) of a path [m]."""
    points = (pose.pose.position for pose in msg.poses)
    return np.array([(point.x, point.y, point.z) for point in points]).reshape(-1, 3)
