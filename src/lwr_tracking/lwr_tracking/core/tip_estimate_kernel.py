# SPDX-License-Identifier: Apache-2.0
"""The compiled tip estimate: what `tip_estimate.TipEstimate` returns."""

import numba
import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_description.compiled import compiled
from lwr_description.kinematics_kernel import jacobian_at
from lwr_tracking.core.products import gram, times
from lwr_tracking.core.spd_solve import solve_spd3

Array = NDArray[np.float64]


class TipEstimate:
    """See `tip_estimate.TipEstimate`; after the constructor nothing is compiled any more."""

    def __init__(self, kinematics: Kinematics) -> None:
        """See `tip_estimate.TipEstimate`."""
        self._arm = kinematics.still, kinematics.tip_site, kinematics.tip_world, kinematics.origin
        self._kinematics = kinematics  # Keeps what these are views of.
        self._compiled = compiled(_measure, *self._arm, *np.zeros((2, len(kinematics.home))))

    def measure(self, q: Array, external_torque: Array) -> tuple[Array, Array]:
        """See `tip_estimate.TipEstimate`."""
        tip_and_force: tuple[Array, Array] = self._compiled(
            *self._arm,
            np.ascontiguousarray(q, dtype=np.float64),
            np.ascontiguousarray(external_torque, dtype=np.float64),
        )
        return tip_and_force


@numba.njit(cache=True)
def _measure(still, tip_site, tip_world, origin, q, external_torque):
    jacobian, tip = np.empty((3, q.shape[0])), np.empty(3)
    jacobian_at(still, tip_site, q, jacobian)
    for k in range(3):
        tip[k] = tip_world[k] - origin[k]
    return tip, solve_spd3(gram(jacobian), times(jacobian, external_torque))
