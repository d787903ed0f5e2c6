# SPDX-License-Identifier: Apache-2.0
"""The compiled inverse kinematics: what `resolved_rate.step` returns."""

import numba
import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_description.kinematics_kernel import jacobian_at
from lwr_tracking.core.products import gram, times
from lwr_tracking.core.resolved_rate import Bounds
from lwr_tracking.core.spd_solve import solve_spd3

Array = NDArray[np.float64]


def step(
    kinematics: Kinematics, bounds: Bounds, command: Array, target: Array, dt: float, draw: float
) -> Array:
    """See `resolved_rate.step`."""
    arm = kinematics
    return _step(
        arm.still, arm.tip_site, arm.tip_world, arm.origin, arm.home, bounds, command, target, dt,
        draw,
    )  # fmt: skip


@numba.njit(cache=True)
def _step(still, tip_site, tip_world, origin, home, bounds, command, target, dt, draw):
    jacobian = np.empty((3, command.shape[0]))
    jacobian_at(still, tip_site, command, jacobian)
    wanted = target - (tip_world - origin)
    size = np.sqrt((wanted * wanted).sum())
    if size > bounds.tip_speed * dt:
        wanted *= bounds.tip_speed * dt / size
    posture = (home - command) * draw
    matrix = gram(jacobian)
    for i in range(3):
        matrix[i, i] += bounds.damping
    solved = solve_spd3(matrix, wanted - times(jacobian, posture))
    move = posture + times(jacobian.T, solved)
    excess = np.abs(move / bounds.velocity).max()
    if excess > dt:
        move *= dt / excess
    high = np.maximum(bounds.position, command)
    low = np.minimum(-bounds.position, command)
    return np.minimum(np.maximum(command + move, low), high)
