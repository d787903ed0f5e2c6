# SPDX-License-Identifier: Apache-2.0
"""Joint position commands ↔ std_msgs/Float64MultiArray, as forward position controllers read."""

import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import Float64MultiArray

from srnn_msgs_py.ros.arrays import doubles, vector


def to_msg(command: NDArray[np.float64]) -> Float64MultiArray:
    """Return the message of a command (n,) [rad]."""
    return Float64MultiArray(data=doubles(command))


def from_msg(msg: Float64MultiArray, joints: int) -> NDArray[np.float64]:
    """Return the command (joints,) [rad], read-only.

    Raises:
        MessageError: the number of values is another one, or one is not finite.

    """
    return vector(msg.data, joints, 'data')
