# SPDX-License-Identifier: Apache-2.0
"""What a measurement tells: whether it can be true, where the tip is, what acts on it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.first_look import FirstLook, Ordinary
from lwr_tracking.core.joint_watch import JointWatch
from lwr_tracking.core.parameters import TrackerParameters
from lwr_tracking.core.point import Point
from srnn_msgs_py.joints import JointSample

Array = NDArray[np.float64]

_NOTHING = Condition.NONE


class Perceived(NamedTuple):
    """What a measurement tells.

    Attributes:
        wrong: what is wrong with it; after `DIVERGED` the rest is true nevertheless.
        strained: a joint needs all the torque that it has.
        tip: x, y and z in `srnn_workspace` [m].
        force: on the tip, along these [N].

    """

    wrong: Condition
    strained: bool
    tip: Point
    force: Point


class Perception:
    """Judges measurements, each by those before it: at a glance, and thoroughly where in doubt."""

    def __init__(self, parameters: TrackerParameters, kinematics: Kinematics) -> None:
        """Have seen nothing of an arm."""
        limits = kinematics.limits
        self._divergence = parameters.limits.joint_divergence
        self._watch = JointWatch(parameters.watch, limits, parameters.period)
        ordinary = Ordinary(
            self._watch.lowest, self._watch.highest, limits.torque_max, self._watch.surely,
            self._divergence,
        )  # fmt: skip
        self._look = FirstLook(kinematics, ordinary)

    def restart(self) -> None:
        """Believe the next measurement that is possible at all."""
        self._watch.restart()

    def take(self, sample: JointSample, command: Array, started: bool) -> Perceived:
        """Take in a measurement.

        Args:
            sample: what the arm measured.
            command: (n,) joint angles that it was told last [rad].
            started: it was told any.

        """
        watch = self._watch
        fine, strained, tip, force = self._look.at(sample, watch.position, command)
        if fine and started and watch.is_new(sample.stamp_ns):
            watch.believe(sample, command)
            return Perceived(_NOTHING, strained, tip, force)
        wrong = watch.judge(sample, command if started else None)
        if not wrong and started and self._diverged(sample, command):
            wrong = Condition.DIVERGED
        return Perceived(wrong, strained, tip, force)

    def _diverged(self, sample: JointSample, command: Array) -> bool:
        return bool(np.abs(command - sample.position).max() > self._divergence)
