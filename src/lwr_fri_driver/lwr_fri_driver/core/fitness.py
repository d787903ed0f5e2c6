# SPDX-License-Identifier: Apache-2.0
"""Whether the arm may be commanded at all, packet by packet."""

from collections.abc import Callable
from enum import Flag, auto
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from lwr_description import POSITION_MAX
from lwr_fri_driver.core.measurement import Measurement
from lwr_fri_driver.core.parameters import SafetyParameters
from lwr_fri_driver.core.words import DRIVES_ON, Control

PERIOD_TOLERANCE = 0.1
"""Share by which the period of the controller may differ from the one that was set."""

Gravity = Callable[[NDArray[np.float64]], NDArray[np.float64]]
"""Torques (7,) [Nm] that hold an arm at angles (7,) [rad]."""

_POSITION_MAX = POSITION_MAX.tolist()


class Unfit(Flag):
    """Why the arm may not be commanded."""

    NONE = 0
    DRIVES_OFF = auto()
    DRIVE_ERROR = auto()
    WARNING = auto()
    POOR_QUALITY = auto()
    NOT_FINITE = auto()
    BEYOND_LIMITS = auto()
    OTHER_CYCLE = auto()
    OTHER_CONTROL = auto()
    OTHER_LOAD = auto()


WORDS = {
    Unfit.DRIVES_OFF: 'drives are off',
    Unfit.DRIVE_ERROR: 'the controller reports an error of a drive',
    Unfit.WARNING: 'the controller reports a warning',
    Unfit.POOR_QUALITY: 'the controller finds the link too poor',
    Unfit.NOT_FINITE: 'a measurement is no finite number',
    Unfit.BEYOND_LIMITS: 'a joint is at its limit',
    Unfit.OTHER_CYCLE: 'the controller sends at another rate than was set',
    Unfit.OTHER_CONTROL: 'the controller moves the arm by another law than was set',
    Unfit.OTHER_LOAD: 'load data or base of the controller are not those of the model',
}


def in_words(unfit: Unfit) -> str:
    """Return all reasons for a person."""
    return ', '.join(WORDS[reason] for reason in unfit)


class Fitness:
    """Judges measurements; the link quality of one packet is judged as it is."""

    def __init__(
        self, cycle: float, parameters: SafetyParameters, control: Control, gravity: Gravity
    ) -> None:
        """Take what is expected.

        Args:
            cycle: time between two packets [s].
            parameters: margins and tolerances.
            control: the law that command mode must have.
            gravity: torques (7,) [Nm] that hold the model at angles (7,) [rad].

        """
        self._cycle = cycle
        self._limits = [limit - parameters.position_margin for limit in _POSITION_MAX]
        self._load_tolerance = parameters.load_tolerance
        self._control = control
        self._gravity = gravity

    def judge(self, measurement: Measurement) -> Unfit:
        """Return all that is wrong with the arm or its controller, whatever its state is."""
        robot, interface, data = measurement.robot, measurement.interface, measurement.data
        unfit = Unfit.NONE
        if robot.power & DRIVES_ON != DRIVES_ON:
            unfit |= Unfit.DRIVES_OFF
        if robot.error:
            unfit |= Unfit.DRIVE_ERROR
        if robot.warning:
            unfit |= Unfit.WARNING
        if not interface.quality.fit:
            unfit |= Unfit.POOR_QUALITY
        if abs(interface.measurement_period - self._cycle) > PERIOD_TOLERANCE * self._cycle:
            unfit |= Unfit.OTHER_CYCLE
        acted_on = (data.joint_position, measurement.target, data.joint_torque,
                    data.external_torque, data.gravity, (interface.safety_limits,))
        if not all(isfinite(value) for values in acted_on for value in values):
            return unfit | Unfit.NOT_FINITE
        if any(
            abs(q) > limit for q, limit in zip(data.joint_position, self._limits, strict=True)
        ):
            unfit |= Unfit.BEYOND_LIMITS
        return unfit

    def judge_control(self, measurement: Measurement) -> Unfit:
        """Return whether command mode has another law than it must have."""
        right = measurement.robot.control is self._control
        return Unfit.NONE if right else Unfit.OTHER_CONTROL

    def judge_load(self, measurement: Measurement) -> Unfit:
        """Return whether controller and model disagree about gravity; for an arm at rest."""
        data = measurement.data
        difference = self._gravity(np.array(data.joint_position)) - data.gravity
        fits = np.abs(difference).max() <= self._load_tolerance
        return Unfit.NONE if fits else Unfit.OTHER_LOAD
