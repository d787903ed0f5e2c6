# SPDX-License-Identifier: Apache-2.0
"""The compiled inverse kinematics: what `resolved_rate.step` returns."""

import numba
import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_description.compiled import compiled
from lwr_description.kinematics_kernel import jacobian_at
from lwr_tracking.core.manipulability import smallest_singular_value
from lwr_tracking.core.point import Point
from lwr_tracking.core.products import gram, times
from lwr_tracking.core.resolved_rate import NEGLIGIBLE, Bounds, Step
from lwr_tracking.core.spd_solve import solve_spd3

Array = NDArray[np.float64]


class ResolvedRate:
    """See `resolved_rate.ResolvedRate`; after the constructor nothing is compiled any more."""

    def __init__(self, kinematics: Kinematics, bounds: Bounds) -> None:
        """See `resolved_rate.ResolvedRate`."""
        self._kinematics = kinematics  # Keeps what the following are views of.
        self._arm = (
            kinematics.still, kinematics.tip_site, kinematics.tip_world, kinematics.origin,
            kinematics.home, bounds,
        )  # fmt: skip
        command = np.zeros(len(kinematics.home))
        self._compiled = compiled(_step, *self._arm, command, (0.0, 0.0, 0.0), 0.0, 0.0)

    def step(self, command: Array, target: Point, dt: float, draw: float) -> Step:
        """See `resolved_rate.ResolvedRate`."""
        return Step(*self._compiled(*self._arm, command, target, dt, draw))


@numba.njit(cache=True)
def _step(still, tip_site, tip_world, origin, home, bounds, command, target, dt, draw):
    joints = command.shape[0]
    jacobian, move, wanted = np.empty((3, joints)), np.empty(joints), np.empty(3)
    jacobian_at(still, tip_site, command, jacobian)
    matrix = gram(jacobian)
    smallest = smallest_singular_value(matrix)
    square = 0.0
    for k in range(3):
        matrix[k, k] += bounds.damping
        wanted[k] = target[k] - (tip_world[k] - origin[k])
        square += wanted[k] ** 2
    reach, size = bounds.tip_speed * dt, np.sqrt(square)
    nearer = reach / size if size > reach else 1.0
    for i in range(joints):
        move[i] = (home[i] - command[i]) * draw
    posture = times(jacobian, move)
    for k in range(3):
        wanted[k] = nearer * wanted[k] - posture[k]
    solved = solve_spd3(matrix, wanted)
    excess = 0.0
    for i in range(joints):
        for k in range(3):
            move[i] += jacobian[k, i] * solved[k]
        excess = max(excess, abs(move[i]) / bounds.velocity[i])
    saturated = excess > dt
    share, outward = dt / excess if saturated else 1.0, 1.0
    for i in range(joints):
        move[i] *= share
        if abs(move[i]) > NEGLIGIBLE * bounds.velocity[i] * dt:
            if move[i] > 0.0:
                left = bounds.highest[i] - command[i]
                zone = bounds.highest[i] - bounds.slow_highest[i]
            else:
                left = command[i] - bounds.lowest[i]
                zone = bounds.slow_lowest[i] - bounds.lowest[i]
            outward = min(outward, left / zone)
    outward = max(outward, 0.0)
    slowed = _dexterity(still, tip_site, bounds, command, move, smallest, jacobian)
    pace = min(outward, slowed)
    for i in range(joints):
        high = max(bounds.highest[i], command[i])
        low = min(bounds.lowest[i], command[i])
        move[i] = min(max(command[i] + pace * move[i], low), high)
    return move, outward, slowed, saturated


@numba.njit(cache=True)
def _dexterity(still, tip_site, bounds, command, move, smallest, jacobian):
    if smallest >= bounds.slow_singular:
        return 1.0
    jacobian_at(still, tip_site, command + move, jacobian)
    if smallest_singular_value(gram(jacobian)) >= smallest:
        return 1.0
    left = (smallest - bounds.singular) / (bounds.slow_singular - bounds.singular)
    return min(max(left, 0.0), 1.0)
