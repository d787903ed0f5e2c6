# SPDX-License-Identifier: Apache-2.0
"""One step of the inverse kinematics on the command side: the plain NumPy reference."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_tracking.core.point import Point
from lwr_tracking.core.spd_solve import solve_spd3

Array = NDArray[np.float64]

NEGLIGIBLE = 1e-3
"""A joint slower than this share of its speed limit does not count as moving."""


class Bounds(NamedTuple):
    """What a step keeps to.

    Attributes:
        lowest: (n,) smallest joint angles [rad].
        highest: (n,) largest joint angles [rad].
        slow_lowest: (n,) joint angles below which motion downwards is slowed down [rad].
        slow_highest: (n,) joint angles above which motion upwards is slowed down [rad].
        velocity: (n,) largest joint speeds [rad/s].
        tip_speed: largest speed of the tip [m/s].
        damping: square of the damping of the inverse [m^2].
        singular: smallest singular value of the Jacobian that is moved to [m/rad].
        slow_singular: below this one motion towards smaller ones is slowed down [m/rad].

    """

    lowest: Array
    highest: Array
    slow_lowest: Array
    slow_highest: Array
    velocity: Array
    tip_speed: float
    damping: float
    singular: float
    slow_singular: float


class Step(NamedTuple):
    """A command, and how free it was.

    Attributes:
        command: (n,) joint angles [rad].
        outward: share of its speed that is left to a joint that nears its limit, 0 to 1.
        dexterity: the same for an arm that nears a singular posture.
        saturated: a joint would have had to be faster than it may.

    """

    command: Array
    outward: float
    dexterity: float
    saturated: bool


class ResolvedRate:
    """One damped Newton step towards a target; what moves the tip not at all goes home."""

    def __init__(self, kinematics: Kinematics, bounds: Bounds) -> None:
        """Take the kinematics of the arm and the bounds of its motion."""
        self._kinematics = kinematics
        self._bounds = bounds

    def step(self, command: Array, target: Point, dt: float, draw: float) -> Step:
        """Return the command whose tip is nearest to the target after `dt`.

        Args:
            command: (n,) last command [rad].
            target: where the tip should be, x, y and z [m].
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
        excess = float(np.abs(move / bounds.velocity).max())
        saturated = excess > dt
        if saturated:
            move *= dt / excess
        outward = self._outward(command, move, dt)
        dexterity = self._dexterity(command, move, jacobian)
        move *= min(outward, dexterity)
        # A command that starts outside the limits must not jump back inside.
        high = np.maximum(bounds.highest, command)
        low = np.minimum(bounds.lowest, command)
        within: Array = np.minimum(np.maximum(command + move, low), high)
        return Step(within, outward, dexterity, saturated)

    def _outward(self, command: Array, move: Array, dt: float) -> float:
        bounds = self._bounds
        moving = np.abs(move) > NEGLIGIBLE * bounds.velocity * dt
        above = (bounds.highest - command) / (bounds.highest - bounds.slow_highest)
        below = (command - bounds.lowest) / (bounds.slow_lowest - bounds.lowest)
        left = np.where(move > 0.0, above, below)
        return float(np.clip(left[moving], 0.0, 1.0).min(initial=1.0))

    def _dexterity(self, command: Array, move: Array, jacobian: Array) -> float:
        bounds = self._bounds
        here = _smallest(jacobian)
        if here >= bounds.slow_singular:
            return 1.0
        if _smallest(self._kinematics.jacobian(command + move)) >= here:
            return 1.0
        left = (here - bounds.singular) / (bounds.slow_singular - bounds.singular)
        return float(np.clip(left, 0.0, 1.0))


def _bounded(vector: Array, length: float) -> Array:
    size = float(vector.dot(vector)) ** 0.5
    return vector if size <= length else vector * (length / size)


def _smallest(jacobian: Array) -> float:
    return float(np.linalg.svd(jacobian, compute_uv=False)[-1])
