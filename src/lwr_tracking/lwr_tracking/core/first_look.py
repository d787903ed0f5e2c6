# SPDX-License-Identifier: Apache-2.0
"""A first look at a measurement: what it says of the tip, and whether to look again.

Almost all measurements are in order, and to find that out is all that most ticks have to do
about them: it is compiled. Whatever is in any way unusual is left to `joint_watch`.
"""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_description.compiled import compiled
from lwr_description.kinematics_kernel import jacobian_at
from lwr_tracking.core.point import Point
from lwr_tracking.core.products import gram, times
from lwr_tracking.core.spd_solve import solve_spd3
from srnn_msgs_py.joints import JointSample

Array = NDArray[np.float64]

_NOWHERE = (np.nan, np.nan, np.nan)


class Ordinary(NamedTuple):
    """What a measurement in order keeps to.

    Attributes:
        lowest: (n,) smallest joint angles [rad].
        highest: (n,) largest joint angles [rad].
        torque: (n,) joint torques of an arm that strains [Nm].
        reach: farthest that any joint has moved since the last measurement [rad].
        divergence: farthest that any joint is from its command [rad].

    """

    lowest: Array
    highest: Array
    torque: Array
    reach: float
    divergence: float


class FirstLook:
    """Looks at measurements; after the constructor nothing is compiled any more."""

    def __init__(self, kinematics: Kinematics, ordinary: Ordinary) -> None:
        """Take the arm, and what is ordinary for it."""
        self._kinematics = kinematics  # Keeps what the following are views of.
        self._arm = (
            kinematics.still, kinematics.tip_site, kinematics.tip_world, kinematics.origin,
            ordinary,
        )  # fmt: skip
        joints = len(kinematics.home)
        self._shape = (joints,)
        self._compiled = compiled(_look, *self._arm, *np.zeros((5, joints)))

    def at(
        self, sample: JointSample, before: Array, command: Array
    ) -> tuple[bool, bool, Point, Point]:
        """Look at a measurement.

        Args:
            sample: what the arm measured.
            before: (n,) joint angles of the last measurement [rad]; NaN if there was none.
            command: (n,) joint angles that the arm was told last [rad].

        Returns:
            Whether it is in order: finite, within its limits, near both `before` and `command`,
            and not `before` again. Whether a joint strains. The tip [m] and the force on it [N]
            as of `tip_estimate`; not finite if the measurement is not.

        """
        position, external = sample.position, sample.external_torque
        if not (position.shape == external.shape == sample.torque.shape == self._shape):
            return False, False, _NOWHERE, _NOWHERE
        found: tuple[bool, bool, Point, Point] = self._compiled(
            *self._arm,
            np.ascontiguousarray(position, dtype=np.float64),
            np.ascontiguousarray(external, dtype=np.float64),
            np.ascontiguousarray(sample.torque, dtype=np.float64),
            before,
            command,
        )
        return found


@numba.njit(cache=True)
def _look(still, tip_site, tip_world, origin, ordinary, q, external, torque, before, command):
    usable, anew, strained, total = True, False, False, 0.0
    for i in range(q.shape[0]):
        total += q[i] + external[i]
        usable &= ordinary.lowest[i] <= q[i] <= ordinary.highest[i]
        usable &= abs(q[i] - before[i]) <= ordinary.reach
        usable &= abs(command[i] - q[i]) <= ordinary.divergence
        anew |= q[i] != before[i]
        strained |= abs(torque[i]) >= ordinary.torque[i]
    # A sum is finite exactly when its terms are; a huge term counts as not finite.
    if not np.isfinite(total):
        nowhere = (np.nan, np.nan, np.nan)
        return False, strained, nowhere, nowhere
    jacobian = np.empty((3, q.shape[0]))
    jacobian_at(still, tip_site, q, jacobian)
    tip = (tip_world[0] - origin[0], tip_world[1] - origin[1], tip_world[2] - origin[2])
    force = solve_spd3(gram(jacobian), times(jacobian, external))
    return usable and anew, strained, tip, (force[0], force[1], force[2])
