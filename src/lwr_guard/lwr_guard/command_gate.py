# SPDX-License-Identifier: Apache-2.0
"""What the arm refuses to be told."""

from enum import Enum
from math import isfinite
from operator import gt, sub, truediv

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lwr_description import DOF, POSITION_MAX, VELOCITY_MAX
from lwr_guard.parameters import GuardParameters

_POSITION_MAX, _VELOCITY_MAX = POSITION_MAX.tolist(), VELOCITY_MAX.tolist()


class Refusal(Enum):
    """Why a joint command was not accepted."""

    MALFORMED = 'not seven numbers'
    NOT_FINITE = 'not finite'
    OUT_OF_RANGE = 'outside the joint limits'
    TOO_FAR = 'further from the last command than the joint speed limits allow'


class CommandGate:
    """Accepts joint positions that the arm could follow; remembers the last good one.

    However many commands come at once, together they ask for no more motion than the joint
    speed limits allow in the time that has passed, and in `silence` beyond it.
    """

    def __init__(self, parameters: GuardParameters, start: NDArray[np.float64]) -> None:
        """Begin as if `start` (7,) [rad] had just been commanded.

        A tracker that begins, begins there; another one may still follow another arm.
        """
        self._parameters = parameters
        self._last = start.copy()
        self._last_time = np.inf
        self._spare = parameters.silence
        self.refused = dict.fromkeys(Refusal, 0)

    def offer(self, q: ArrayLike, now: float) -> Refusal | None:
        """Judge the command `q` (7,) [rad] at time `now` [s]; None means accepted."""
        angles = _seven_numbers(q)
        if isinstance(angles, Refusal):
            return self._refuse(angles)
        period, silence = self._parameters.period, self._parameters.silence
        elapsed = max(now - self._last_time, 0.0)
        spare = min(self._spare + elapsed, silence)
        moved = map(abs, map(sub, angles, self._last.tolist()))
        needed = max(map(truediv, moved, _VELOCITY_MAX))
        if needed > min(max(elapsed, period), spare):
            return self._refuse(Refusal.TOO_FAR)
        self._spare = spare - needed
        self._last[:] = angles
        self._last_time = now
        return None

    @property
    def last(self) -> NDArray[np.float64]:
        """The last accepted command (7,) [rad]; a view."""
        return self._last

    def _refuse(self, refusal: Refusal) -> Refusal:
        self.refused[refusal] += 1
        return refusal


def _seven_numbers(q: ArrayLike) -> list[float] | Refusal:
    """Return joint angles that the arm has, or what is wrong with them."""
    try:
        angles = np.asarray(q, dtype=float)
    except (TypeError, ValueError, OverflowError):
        return Refusal.MALFORMED
    if angles.shape != (DOF,):
        return Refusal.MALFORMED
    # Seven floats one by one are judged faster than as an array.
    asked: list[float] = angles.tolist()
    if not all(map(isfinite, asked)):
        return Refusal.NOT_FINITE
    if any(map(gt, map(abs, asked), _POSITION_MAX)):
        return Refusal.OUT_OF_RANGE
    return asked
