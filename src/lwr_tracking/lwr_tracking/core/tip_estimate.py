# SPDX-License-Identifier: Apache-2.0
"""Where the tip is and what pushes it: the plain NumPy reference."""

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_tracking.core.spd_solve import solve_spd3

Array = NDArray[np.float64]


class TipEstimate:
    """Tip and force at the tip from angles and external torques.

    The force explains the torques best, by least squares of J^T f = tau: f = (J J^T)^-1 J tau.
    On this mount it finds contacts as early as the dynamically consistent inverse, without
    the mass matrix in every cycle.
    """

    def __init__(self, kinematics: Kinematics) -> None:
        """Take the kinematics of the arm."""
        self._kinematics = kinematics

    def measure(self, q: Array, external_torque: Array) -> tuple[Array, Array]:
        """Return the tip (3,) [m] and the force on it (3,) [N].

        Args:
            q: (n,) joint angles [rad].
            external_torque: (n,) [Nm].

        """
        tip, jacobian = self._kinematics.tip_and_jacobian(q)
        return tip, solve_spd3(jacobian.dot(jacobian.T), jacobian.dot(external_torque))
