# SPDX-License-Identifier: Apache-2.0
"""What the arm refuses to be told."""

from enum import Enum
from math import isfinite
from operator import gt, sub

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
    """Accepts joint positions that the arm could follow; remembers the last good one."""

    def __init__(self, parameters: GuardParameters, start: NDArray[np.float64]) -> None:
        """Begin as if `start` (7,) [rad] had just been commanded.

        A tracker that begins, begins there; another one may still follow another arm.
        """
        self._parameters = parameters
        self._last = start.copy()
        self._last_time = np.inf
        self.refused = dict.fromkeys(Refusal, 0)

    def offer(self, q: ArrayLike, now: float) -> Refusal | None:
        """Judge the command `q` (7,) [rad] at time `now` [s]; None means accepted."""
        refusal = self._judge(q, now)
        if refusal is None:
            self._last[:] = q
            self._last_time = now
        else:
            self.refused[refusal] += 1
        return refusal

    @property
    def last(self) -> NDArray[np.float64]:
        """The last accepted command (7,) [rad]; a view."""
        return self._last

    def _judge(self, q: ArrayLike, now: float) -> Refusal | None:
        try:
            angles = np.asarray(q, dtype=float)
        except (TypeError, ValueError):
            return Refusal.MALFORMED
        if angles.shape != (DOF,):
            return Refusal.MALFORMED
        # Seven floats one by one are judged faster than as an array.
        asked, last = angles.tolist(), self._last.tolist()
        if not all(map(isfinite, asked)):
            return Refusal.NOT_FINITE
        if any(map(gt, map(abs, asked), _POSITION_MAX)):
            return Refusal.OUT_OF_RANGE
        elapsed = max(now - self._last_time, self._parameters.period)
        seconds = min(elapsed, self._parameters.silence)
        reach = [speed * seconds for speed in _VELOCITY_MAX]
        far = any(map(gt, map(abs, map(sub, asked, last)), reach))
        return Refusal.TOO_FAR if far else None
