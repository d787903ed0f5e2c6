# SPDX-License-Identifier: Apache-2.0
"""What the controller objects to in a command; its words are for the operator."""

import numpy as np
from numpy.typing import NDArray

from lwr_description import POSITION_MAX
from lwr_sim_bridge.fri.wire import Order

JOINT_POSITION, JOINT_LAW = 0x0001, 0x0030
"""Command flags: joint positions count; joint stiffness and damping do."""

START_TORQUE = 1.0
"""Command mode ends at once with more than about this on top of the law [Nm]."""

STIFFNESS, DAMPING = (0.01, 2000.0), (0.1, 1.0)
"""Least and most, [Nm/rad] and share of critical."""

ROUNDING = 1e-6
"""Single precision of an angle [rad]."""

_WIDE = 1.0 + 1e-6
"""Single precision of what was permitted."""


def objection_to_start(
    order: Order, target: NDArray[np.float64], tolerance: float
) -> str:
    """Return what speaks against command mode from this command on, nothing if nothing does.

    Args:
        order: newest command.
        target: (7,) where the arm is held [rad].
        tolerance: how far the command may be from there [rad].

    """
    if not order.finite:
        return 'FRI: a number of the command is none'
    if not order.flags & JOINT_POSITION:
        return 'FRI: no joint positions in the command'
    if np.abs(np.array(order.position) - target).max() > tolerance + ROUNDING:
        return 'FRI interpolation error: the command is not where the arm is held'
    if np.abs(order.torque).max() > START_TORQUE:
        return 'FRI: cmd.addJntTrq not properly initialized'
    return ''


def objection_to(
    order: Order, flags: int, target: NDArray[np.float64], step: NDArray[np.float64]
) -> str:
    """Return why a command may not be followed in command mode, nothing if it may.

    Args:
        order: command.
        flags: of the command that command mode began with.
        target: (7,) where the last one was heading, or what stood in for it [rad].
        step: (7,) longest way of each joint in a cycle [rad].

    """
    if not order.finite:
        return 'FRI: a number of the command is none'
    if order.flags != flags:
        return 'FRI: flags have changed in command mode'
    position = np.array(order.position)
    if (np.abs(position) > POSITION_MAX + ROUNDING).any():
        return 'FRI: a joint is commanded beyond its limit'
    if (np.abs(position - target) > step * _WIDE + ROUNDING).any():
        return 'FRI interpolation error: excessive commanded joint speed'
    if flags & JOINT_LAW == JOINT_LAW and not (
        _within(order.stiffness, STIFFNESS) and _within(order.damping, DAMPING)
    ):
        return 'FRI: stiffness or damping out of range'
    return ''


def _within(values: tuple[float, ...], bounds: tuple[float, float]) -> bool:
    least, most = bounds
    return all(least * (1.0 - 1e-6) <= value <= most * _WIDE for value in values)
