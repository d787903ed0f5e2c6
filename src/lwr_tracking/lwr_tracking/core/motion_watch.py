# SPDX-License-Identifier: Apache-2.0
"""Whether the arm can do what it is told: joint limits, singular postures, saturation."""

from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.parameters import LimitParameters
from lwr_tracking.core.resolved_rate import Step

CREEPING = 0.1
"""Motion that has only this share of its speed left has come to its limit."""


class MotionWatch:
    """Names what has hindered motion for too long.

    Shorter than `limits.patience` it is what a disturbance does, and the arm catches up.
    """

    def __init__(self, limits: LimitParameters) -> None:
        """Have seen nothing."""
        self._patience = limits.patience
        self._lasted: dict[Condition, float] = {}

    def judge(self, dt: float, freedom: Step, strained: bool, running: bool) -> Condition:
        """Return what has lasted too long, `Condition.NONE` if nothing has.

        Args:
            dt: time since the last measurement [s].
            freedom: how free the last command was.
            strained: a joint needs all the torque that it has.
            running: a segment is being executed; else nothing has to move.

        """
        _, outward, dexterity, saturated = freedom
        slow = running and (outward < CREEPING or dexterity < CREEPING)
        if not (slow or saturated or strained):
            self._lasted.clear()
            return Condition.NONE
        found = {
            Condition.JOINT_LIMIT: running and outward < CREEPING,
            Condition.SINGULAR: running and dexterity < CREEPING,
            Condition.SATURATED: saturated or strained,
        }
        self._lasted = {c: self._lasted.get(c, 0.0) + dt for c, there in found.items() if there}
        # Times are sums of ticks, and not exact.
        limit = self._patience - 1e-9
        return next((c for c, t in self._lasted.items() if t >= limit), Condition.NONE)
