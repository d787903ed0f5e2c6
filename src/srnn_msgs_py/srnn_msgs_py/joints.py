# SPDX-License-Identifier: Apache-2.0
"""What the arm reports in one cycle."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class JointSample:
    """One measurement of the arm, FRI order and signs.

    Attributes:
        stamp_ns: time of measurement [ns of ROS time].
        position: (7,) joint angles [rad].
        velocity: (7,) joint velocities [rad/s].
        torque: (7,) measured joint torques [Nm].
        external_torque: (7,) the arm's own estimate of the external torques [Nm].
        lag_ns: how much later the external torques were measured [ns].

    """

    stamp_ns: int
    position: NDArray[np.float64]
    velocity: NDArray[np.float64]
    torque: NDArray[np.float64]
    external_torque: NDArray[np.float64]
    lag_ns: int = 0
