# SPDX-License-Identifier: Apache-2.0
"""TipPosition ↔ geometry_msgs/PoseStamped; the orientation carries no meaning."""

from geometry_msgs.msg import PoseStamped
import numpy as np
from std_msgs.msg import Header

from srnn_msgs_py.ros.mark_carrier import plain_frame
from srnn_msgs_py.ros.points import pose_at, xyz
from srnn_msgs_py.ros.stamp import stamp_from_msg, stamp_to_msg
from srnn_msgs_py.tip import TipPosition


def to_msg(tip: TipPosition) -> PoseStamped:
    """Return the message of a tip position."""
    return PoseStamped(
        header=Header(stamp=stamp_to_msg(tip.stamp_ns), frame_id=str(tip.frame)),
        pose=pose_at(tip.position),
    )


def from_msg(msg: PoseStamped) -> TipPosition:
    """Return the tip position of a message.

    Raises:
        MessageError: a coordinate is not finite.

    """
    position = np.array(xyz(msg.pose.position, 'position'))
    return TipPosition(stamp_from_msg(msg.header.stamp), position, plain_frame(msg.header))
