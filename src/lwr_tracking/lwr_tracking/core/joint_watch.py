# SPDX-License-Identifier: Apache-2.0
"""Whether a measurement can be true, judged by those before it."""

from collections.abc import Iterable
from math import isfinite
from operator import gt, lt, sub

import numpy as np
from numpy.typing import NDArray

from lwr_description import JointLimits
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.parameters import WatchParameters
from lwr_tracking.core.tick_watch import AT_REST_AFTER
from srnn_msgs_py.joints import JointSample

_JUMP = 2.0
"""No joint can have moved farther than this many times its speed limit allows."""

_COASTED = 0.03
"""No joint goes on farther than this once commands have ceased [rad]."""


class JointWatch:
    """Looks at what joint states say, not at whether they come.

    A sender may be alive and its content dead: angles that do not change while the arm
    is told to move, a stamp that stands still, angles that no arm can have got to. Refused
    angles are not remembered, so that an arm which seems to have jumped is not believed
    until it is back, or until `restart`.
    """

    def __init__(self, parameters: WatchParameters, limits: JointLimits, period: float) -> None:
        """Have seen nothing.

        Args:
            parameters: what a joint state must obey.
            limits: what the n joints may do at most.
            period: nominal time between two joint states [s].

        """
        self._parameters = parameters
        self._period = period
        self._reach = (_JUMP * limits.velocity_max).tolist()
        self._surely = min(self._reach) * period
        tolerance = parameters.position_tolerance
        self._lowest = (limits.position_min - tolerance).tolist()
        self._highest = (limits.position_max + tolerance).tolist()
        self.restart()

    def restart(self) -> None:
        """Believe the next measurement that is possible at all."""
        self._position: list[float] | None = None
        self._stamp_ns = 0
        self._repeats = 0
        self._told: list[float] | None = None

    def judge(self, sample: JointSample, command: NDArray[np.float64] | None) -> Condition:
        """Return what is wrong with a measurement, `Condition.NONE` if nothing is.

        Args:
            sample: what the arm measured.
            command: (n,) joint angles that it was told last [rad]; None before the first.

        """
        if not _usable(sample, len(self._reach)):
            return Condition.BAD_SAMPLE
        position = sample.position.tolist()
        if _exceeds(position, self._highest) or any(map(lt, position, self._lowest)):
            return Condition.OUT_OF_RANGE
        if self._position is None:
            self._remember(position, sample.stamp_ns, command)
            return Condition.NONE
        if position == self._position or sample.stamp_ns == self._stamp_ns:
            return self._repeated(sample.stamp_ns, command)
        moved = [*map(abs, map(sub, position, self._position))]
        if max(moved) > self._surely and self._too_far(moved, sample.stamp_ns):
            self._stamp_ns = sample.stamp_ns
            return Condition.JUMPED
        self._remember(position, sample.stamp_ns, command)
        return Condition.NONE

    def _repeated(self, stamp_ns: int, command: NDArray[np.float64] | None) -> Condition:
        """Count a measurement that says what the last one said."""
        same_stamp = stamp_ns == self._stamp_ns
        self._stamp_ns = stamp_ns
        if not (same_stamp or self._told_to_move(command)):
            return Condition.NONE
        self._repeats += 1
        return Condition.FROZEN if self._repeats >= self._parameters.repeats else Condition.NONE

    def _told_to_move(self, command: NDArray[np.float64] | None) -> bool:
        if command is None or self._told is None:
            return False
        moved = map(abs, map(sub, command.tolist(), self._told))
        return bool(max(moved) > self._parameters.motion)

    def _too_far(self, moved: list[float], stamp_ns: int) -> bool:
        # Bounded on both sides: the system clock, from which stamps are, may be set.
        elapsed = max(1e-9 * (stamp_ns - self._stamp_ns), self._period)
        if elapsed > AT_REST_AFTER:
            # Nobody has moved it meanwhile: elsewhere it is another arm.
            return max(moved) > _COASTED
        seconds = min(elapsed, self._parameters.gap)
        return _exceeds(moved, [speed * seconds for speed in self._reach])

    def _remember(
        self, position: list[float], stamp_ns: int, command: NDArray[np.float64] | None
    ) -> None:
        self._position, self._stamp_ns, self._repeats = position, stamp_ns, 0
        self._told = None if command is None else command.tolist()


def _exceeds(values: Iterable[float], limits: Iterable[float]) -> bool:
    # A few floats one by one are compared faster than as an array.
    return any(map(gt, values, limits))


def _usable(sample: JointSample, joints: int) -> bool:
    """Tell whether all that the tracker reads is finite and has one element per joint."""
    position, torque = sample.position, sample.external_torque
    # A sum is finite exactly when its terms are; a huge term counts as not finite.
    return position.shape == torque.shape == (joints,) and isfinite(
        sum(position.tolist()) + sum(torque.tolist())
    )
