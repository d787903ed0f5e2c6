# SPDX-License-Identifier: Apache-2.0
"""Wrench ↔ geometry_msgs/WrenchStamped, both estimated and true."""

from geometry_msgs.msg import Wrench as WrenchMsg
from geometry_msgs.msg import WrenchStamped
import numpy as np
from std_msgs.msg import Header

from srnn_msgs_py.ros.points import vector_to_msg, xyz
from srnn_msgs_py.ros.stamp import stamp_from_msg, stamp_to_msg
from srnn_msgs_py.wrench import Wrench


def to_msg(wrench: Wrench) -> WrenchStamped:
    """Return the message of a wrench."""
    return WrenchStamped(
        header=Header(stamp=stamp_to_msg(wrench.stamp_ns), frame_id=str(wrench.frame)),
        wrench=WrenchMsg(
            force=vector_to_msg(wrench.force), torque=vector_to_msg(wrench.torque)
        ),
    )


def from_msg(msg: WrenchStamped) -> Wrench:
    """Return the wrench of a message.

    Raises:
        MessageError: a component is not finite.

    """
    return Wrench(
        stamp_ns=stamp_from_msg(msg.header.stamp),
        frame=str(msg.header.frame_id),
        force=np.array(xyz(msg.wrench.force, 'force')),
        torque=np.array(xyz(msg.wrench.torque, 'torque')),
    )
