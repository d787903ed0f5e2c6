# SPDX-License-Identifier: Apache-2.0
"""Whether the arm can do what it is told: joint limits, singular postures, saturation."""

from operator import ge

import numpy as np
from numpy.typing import NDArray

from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.parameters import LimitParameters
from lwr_tracking.core.resolved_rate import Step
from srnn_msgs_py.joints import JointSample

CREEPING = 0.1
"""Motion that has only this share of its speed left has come to its limit."""


class MotionWatch:
    """Names what has hindered motion for too long.

    Shorter than `limits.patience` it is what a disturbance does, and the arm catches up.
    """

    def __init__(self, limits: LimitParameters, torque_max: NDArray[np.float64]) -> None:
        """Have seen nothing; the joints have torque limits (n,) [Nm]."""
        self._torque_max = torque_max.tolist()
        self._patience = limits.patience
        self._lasted = dict.fromkeys(
            (Condition.JOINT_LIMIT, Condition.SINGULAR, Condition.SATURATED), 0.0
        )

    def judge(self, dt: float, freedom: Step, sample: JointSample, running: bool) -> Condition:
        """Return what has lasted too long, `Condition.NONE` if nothing has.

        Args:
            dt: time since the last measurement [s].
            freedom: how free the last command was.
            sample: what the arm measured.
            running: a segment is being executed; else nothing has to move.

        """
        # A few floats one by one are compared faster than as an array.
        torque = any(map(ge, map(abs, sample.torque.tolist()), self._torque_max))
        found = (
            running and freedom.outward < CREEPING,
            running and freedom.dexterity < CREEPING,
            freedom.saturated or torque,
        )
        for condition, there in zip(self._lasted, found, strict=True):
            self._lasted[condition] = self._lasted[condition] + dt if there else 0.0
        # Times are sums of ticks, and not exact.
        limit = self._patience - 1e-9
        return next((c for c, t in self._lasted.items() if t >= limit), Condition.NONE)
