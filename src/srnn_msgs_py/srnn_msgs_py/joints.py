# SPDX-License-Identifier: Apache-2.0
"""What the arm reports in one cycle."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class JointSample:
    """One measurement of the arm, joints in the order of its description.

    Attributes:
        stamp_ns: time of measurement [ns of ROS time].
        position: (n,) joint angles [rad].
        velocity: (n,) joint velocities [rad/s].
        torque: (n,) measured joint torques [Nm].
        external_torque: (n,) the arm's own estimate of the external torques [Nm].
        lag_ns: how much later the external torques were measured [ns].

    """

    stamp_ns: int
    position: NDArray[np.float64]
    velocity: NDArray[np.float64]
    torque: NDArray[np.float64]
    external_torque: NDArray[np.float64]
    lag_ns: int = 0
