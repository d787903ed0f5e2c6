# SPDX-License-Identifier: Apache-2.0
"""Joint commands whose forward kinematics follow the reference."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_description.compiled import compiled
from lwr_tracking.core.bounded_sum import add_bounded
from lwr_tracking.core.parameters import LawParameters, LimitParameters
from lwr_tracking.core.point import Point
from lwr_tracking.core.resolved_rate import Bounds, Step
from lwr_tracking.core.resolved_rate_kernel import ResolvedRate

Array = NDArray[np.float64]

_NONE: Point = (0.0, 0.0, 0.0)


class TrackingLaw:
    """Resolved-rate inverse kinematics on the command side, corrected by measurement.

    Every step is one damped Newton step towards the target (Whitney 1969; damping after
    Nakamura and Hanafusa 1986), so commanded velocity is that of the target without being
    asked for; what moves the tip not at all draws the joints home. A slow bounded
    integral of the measured error makes up for sag and friction of the arm.

    Attributes:
        command: (n,) last commanded joint angles [rad].
        correction: integral correction of the commanded tip, x, y and z [m].
        freedom: how free the last command was; what it holds of a command is `command`.

    """

    def __init__(
        self, law: LawParameters, limits: LimitParameters, kinematics: Kinematics
    ) -> None:
        """Command the home posture until `start` is called."""
        self.command = np.array(kinematics.home)
        self.correction = _NONE
        self.freedom = Step(self.command, 1.0, 1.0, False)
        self._law = law
        joints = kinematics.limits
        self._velocity_max = joints.velocity_max * limits.velocity_share
        bounds = Bounds(
            lowest=joints.position_min + limits.position_margin,
            highest=joints.position_max - limits.position_margin,
            slow_lowest=joints.position_min + limits.slow_margin,
            slow_highest=joints.position_max - limits.slow_margin,
            velocity=self._velocity_max,
            tip_speed=law.tip_speed,
            damping=law.damping**2,
            singular=limits.singular,
            slow_singular=limits.slow_singular,
        )
        self._kinematics = kinematics
        self._inverse = ResolvedRate(kinematics, bounds)
        self._add = compiled(add_bounded, _NONE, _NONE, 0.0, 0.0)

    @property
    def held(self) -> Point:
        """Return the target (x, y, z) [m] that asks for no motion beyond the last command."""
        x, y, z = (self._kinematics.tip(self.command) - self.correction).tolist()
        return x, y, z

    def start(self, position: Array) -> None:
        """Command the measured joint angles (n,) [rad], without correction."""
        self.command = np.array(position, dtype=np.float64)
        self.correction = _NONE

    def follow(self, position: Array, dt: float) -> None:
        """Let the command approach the measured joint angles (n,) [rad] within `dt` [s]."""
        reach = self._velocity_max * dt
        self.command = self.command + np.clip(position - self.command, -reach, reach)

    def correct(self, error: Point, dt: float) -> None:
        """Integrate where the tip should be minus where it is (x, y, z) [m], over `dt` [s]."""
        law = self._law
        self.correction = self._add(
            self.correction, error, law.integral_gain * dt, law.integral_limit
        )

    def step(self, target: Sequence[float], dt: float, settle: bool = True) -> Array:
        """Return the command (n,) [rad] whose tip is nearest to the target after `dt`.

        Args:
            target: reference of the tip, x, y and z [m].
            dt: time since the last command [s].
            settle: draw the joints home as well.

        """
        draw = self._law.posture_gain * dt if settle else 0.0
        (x, y, z), (cx, cy, cz) = target, self.correction
        wanted = (x + cx, y + cy, z + cz)
        self.freedom = self._inverse.step(self.command, wanted, dt, draw)
        self.command = self.freedom.command
        return self.command
