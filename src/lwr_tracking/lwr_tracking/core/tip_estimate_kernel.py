# SPDX-License-Identifier: Apache-2.0
"""The compiled tip estimate: what `tip_estimate.tip_and_force` returns."""

import numba
import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_description.kinematics_kernel import jacobian_at
from lwr_tracking.core.products import gram, times
from lwr_tracking.core.spd_solve import solve_spd3

Array = NDArray[np.float64]


def tip_and_force(kinematics: Kinematics, q: Array, external_torque: Array) -> tuple[Array, Array]:
    """See `tip_estimate.tip_and_force`."""
    arm = kinematics
    # Copies: measurements may be read-only, which to numba is another type.
    return _tip_and_force(
        arm.still, arm.tip_site, arm.tip_world, arm.origin, np.array(q), np.array(external_torque)
    )


@numba.njit(cache=True)
def _tip_and_force(still, tip_site, tip_world, origin, q, external_torque):
    jacobian = np.empty((3, q.shape[0]))
    jacobian_at(still, tip_site, q, jacobian)
    force = solve_spd3(gram(jacobian), times(jacobian, external_torque))
    return tip_world - origin, force
