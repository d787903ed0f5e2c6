# SPDX-License-Identifier: Apache-2.0
"""Fine interpolation of joint commands, from their irregular rate to the controller's."""

from math import exp

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Interpolator:
    """Critically damped second-order filter: smooth position *and* velocity, no overshoot.

    q'' = w^2 (u - q) - 2 w q' with w = 1 / time_constant, solved exactly for a command u that
    is constant during one tick. A ramp is followed 2 time constants late. Without a new
    command the motion comes to rest at the last one.

    Attributes:
        position: (n,) desired joint angles [rad]; a view that `step` changes.
        velocity: (n,) desired joint velocities [rad/s]; a view that `step` changes.

    """

    def __init__(self, start: Array, time_constant: float, tick: float) -> None:
        """Rest at `start`.

        Args:
            start: (n,) joint angles [rad].
            time_constant: 1 / w [s].
            tick: time between two calls of `step` [s].

        """
        self._transition = transition(time_constant, tick)
        self._state = np.array([start, np.zeros_like(start), start], dtype=float)
        self._moving = self._state[:2]
        self._next = np.empty_like(self._moving)
        self.position, self.velocity, self._command = self._state

    def command(self, q: Array) -> None:
        """Head for the joint angles `q` (n,) [rad] from the next tick on."""
        self._command[:] = q

    def step(self) -> None:
        """Advance by one tick."""
        np.dot(self._transition, self._state, out=self._next)
        self._moving[:] = self._next


def transition(time_constant: float, tick: float) -> Array:
    """Return (2, 3): position and velocity after a tick from position, velocity and command.

    Args:
        time_constant: 1 / w [s].
        tick: length of the tick [s].

    """
    w = 1.0 / time_constant
    decay = exp(-w * tick)
    stay = decay * (1.0 + w * tick)
    pull = decay * w * w * tick
    return np.array([[stay, decay * tick, 1.0 - stay], [-pull, decay * (1.0 - w * tick), pull]])
