# SPDX-License-Identifier: Apache-2.0
"""One step of the inverse kinematics on the command side: the plain NumPy reference."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_tracking.core.spd_solve import solve_spd3

Array = NDArray[np.float64]


class Bounds(NamedTuple):
    """What a step keeps to.

    Attributes:
        position: (7,) largest joint angles of either sign [rad].
        velocity: (7,) largest joint speeds [rad/s].
        tip_speed: largest speed of the tip [m/s].
        damping: square of the damping of the inverse [m^2].

    """

    position: Array
    velocity: Array
    tip_speed: float
    damping: float


class ResolvedRate:
    """One damped Newton step towards a target; what moves the tip not at all goes home."""

    def __init__(self, kinematics: Kinematics, bounds: Bounds) -> None:
        """Take the kinematics of the arm and the bounds of its motion."""
        self._kinematics = kinematics
        self._bounds = bounds

    def step(self, command: Array, target: Array, dt: float, draw: float) -> Array:
        """Return the command (7,) [rad] whose tip is nearest to the target after `dt`.

        Args:
            command: (7,) last command [rad].
            target: (3,) where the tip should be [m].
            dt: time since the last command [s].
            draw: share of the way home that the joints go if the tip allows.

        """
        bounds = self._bounds
        tip, jacobian = self._kinematics.tip_and_jacobian(command)
        wanted = _bounded(target - tip, bounds.tip_speed * dt)
        posture = (self._kinematics.home - command) * draw
        gram = jacobian.dot(jacobian.T) + bounds.damping * np.eye(3)
        move = posture + jacobian.T.dot(solve_spd3(gram, wanted - jacobian.dot(posture)))
        # One factor for all joints keeps the direction of the tip.
        excess = np.abs(move / bounds.velocity).max()
        if excess > dt:
            move *= dt / excess
        # A command that starts outside the limits must not jump back inside.
        high = np.maximum(bounds.position, command)
        low = np.minimum(-bounds.position, command)
        within: Array = np.minimum(np.maximum(command + move, low), high)
        return within


def _bounded(vector: Array, length: float) -> Array:
    size = float(vector.dot(vector)) ** 0.5
    return vector if size <= length else vector * (length / size)
