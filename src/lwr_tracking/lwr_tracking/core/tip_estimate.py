# SPDX-License-Identifier: Apache-2.0
"""Where the tip is and what pushes it: the plain NumPy reference."""

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_tracking.core.spd_solve import solve_spd3

Array = NDArray[np.float64]


def tip_and_force(kinematics: Kinematics, q: Array, external_torque: Array) -> tuple[Array, Array]:
    """Return the tip (3,) [m] and the force (3,) [N] that explains external torques best.

    Least squares of J^T f = tau: f = (J J^T)^-1 J tau. On this mount it finds contacts as
    early as the dynamically consistent inverse, without the mass matrix in every cycle.

    Args:
        kinematics: of the arm.
        q: (7,) joint angles [rad].
        external_torque: (7,) [Nm].

    """
    tip, jacobian = kinematics.tip_and_jacobian(q)
    return tip, solve_spd3(jacobian.dot(jacobian.T), jacobian.dot(external_torque))
