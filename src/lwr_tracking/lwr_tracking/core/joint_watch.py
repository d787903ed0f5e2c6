# SPDX-License-Identifier: Apache-2.0
"""Whether a measurement can be true, judged by those before it."""

from collections.abc import Iterable
from math import isfinite, isnan
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


Array = NDArray[np.float64]


class JointWatch:
    """Looks at what joint states say, not at whether they come.

    A sender may be alive and its content dead: angles that do not change while the arm
    is told to move, a stamp that stands still, angles that no arm can have got to. Refused
    angles are not remembered, so that an arm which seems to have jumped is not believed
    until it is back, or until `restart`.

    Attributes:
        position: (n,) the last angles that were believed [rad]; NaN before the first.
        lowest: (n,) smallest angles that are believed [rad].
        highest: (n,) largest angles that are believed [rad].
        surely: farthest that any joint may have moved, however soon it is measured again [rad].

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
        self.surely = min(self._reach) * period
        self.lowest = limits.position_min - parameters.position_tolerance
        self.highest = limits.position_max + parameters.position_tolerance
        self.restart()

    def restart(self) -> None:
        """Believe the next measurement that is possible at all."""
        self.position = np.full(len(self._reach), np.nan)
        self._stamp_ns = 0
        self._repeats = 0
        self._told: Array | None = None

    def believe(self, sample: JointSample, command: Array | None) -> None:
        """Take in a measurement that is true; see `judge`."""
        self.position = np.array(sample.position, dtype=np.float64)
        self._stamp_ns, self._repeats, self._told = sample.stamp_ns, 0, command

    def judge(self, sample: JointSample, command: Array | None) -> Condition:
        """Return what is wrong with a measurement, `Condition.NONE` if nothing is.

        Args:
            sample: what the arm measured.
            command: (n,) joint angles that it was told last [rad]; None before the first.

        """
        if not _usable(sample, len(self._reach)):
            return Condition.BAD_SAMPLE
        position, before = sample.position.tolist(), self.position.tolist()
        if _exceeds(position, self.highest) or any(map(lt, position, self.lowest)):
            return Condition.OUT_OF_RANGE
        if isnan(before[0]):
            self.believe(sample, command)
            return Condition.NONE
        if position == before or sample.stamp_ns == self._stamp_ns:
            return self._repeated(sample.stamp_ns, command)
        moved = [*map(abs, map(sub, position, before))]
        if max(moved) > self.surely and self._too_far(moved, sample.stamp_ns):
            self._stamp_ns = sample.stamp_ns
            return Condition.JUMPED
        self.believe(sample, command)
        return Condition.NONE

    def is_new(self, stamp_ns: int) -> bool:
        """Tell whether a stamp [ns] is another one than that of the last measurement."""
        return stamp_ns != self._stamp_ns

    def _repeated(self, stamp_ns: int, command: Array | None) -> Condition:
        """Count a measurement that says what the last one said."""
        same_stamp = stamp_ns == self._stamp_ns
        self._stamp_ns = stamp_ns
        if not (same_stamp or self._told_to_move(command)):
            return Condition.NONE
        self._repeats += 1
        return Condition.FROZEN if self._repeats >= self._parameters.repeats else Condition.NONE

    def _told_to_move(self, command: Array | None) -> bool:
        if command is None or self._told is None:
            return False
        return bool(np.abs(command - self._told).max() > self._parameters.motion)

    def _too_far(self, moved: list[float], stamp_ns: int) -> bool:
        # Bounded on both sides: the system clock, from which stamps are, may be set.
        elapsed = max(1e-9 * (stamp_ns - self._stamp_ns), self._period)
        if elapsed > AT_REST_AFTER:
            # Nobody has moved it meanwhile: elsewhere it is another arm.
            return max(moved) > _COASTED
        seconds = min(elapsed, self._parameters.gap)
        return _exceeds(moved, [speed * seconds for speed in self._reach])


def _exceeds(values: Iterable[float], limits: Iterable[float]) -> bool:
    # A few floats one by one are compared faster than as an array.
    return any(map(gt, values, limits))


def _usable(sample: JointSample, joints: int) -> bool:
    """Tell whether all that the tracker reads is finite and has one element per joint."""
    position, torque, shape = sample.position, sample.external_torque, (joints,)
    # A sum is finite exactly when its terms are; a huge term counts as not finite.
    return position.shape == torque.shape == sample.torque.shape == shape and isfinite(
        sum(position.tolist()) + sum(torque.tolist())
    )
