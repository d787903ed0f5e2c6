# SPDX-License-Identifier: Apache-2.0
"""What the arm refuses to be told."""

from enum import Enum
from math import isfinite
from operator import gt, lt, sub, truediv

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lwr_description import JointLimits
from lwr_guard.parameters import GuardParameters


class Refusal(Enum):
    """Why a joint command was not accepted."""

    MALFORMED = 'not one number for each joint'
    NOT_FINITE = 'not finite'
    OUT_OF_RANGE = 'outside the joint limits'
    TOO_FAR = 'further from the last command than the joint speed limits allow'


class CommandGate:
    """Accepts joint positions that the arm could follow; remembers the last good one.

    However many commands come at once, together they ask for no more motion than the joint
    speed limits allow in the time that has passed, and in `silence` beyond it.
    """

    def __init__(
        self, parameters: GuardParameters, limits: JointLimits, start: NDArray[np.float64]
    ) -> None:
        """Begin as if `start` had just been commanded.

        A tracker that begins, begins there; another one may still follow another arm.

        Args:
            parameters: what a stream of commands must keep to.
            limits: what the n joints may do at most.
            start: (n,) joint angles [rad].

        """
        self._parameters = parameters
        self._lowest, self._highest = limits.position_min.tolist(), limits.position_max.tolist()
        self._velocity_max = limits.velocity_max.tolist()
        self._last = start.copy()
        self._last_time = np.inf
        self._spare = parameters.silence
        self.refused = dict.fromkeys(Refusal, 0)

    def offer(self, q: ArrayLike, now: float) -> Refusal | None:
        """Judge the command `q` (n,) [rad] at time `now` [s]; None means accepted."""
        angles = self._possible(q)
        if isinstance(angles, Refusal):
            return self._refuse(angles)
        period, silence = self._parameters.period, self._parameters.silence
        elapsed = max(now - self._last_time, 0.0)
        spare = min(self._spare + elapsed, silence)
        moved = map(abs, map(sub, angles, self._last.tolist()))
        needed = max(map(truediv, moved, self._velocity_max))
        if needed > min(max(elapsed, period), spare):
            return self._refuse(Refusal.TOO_FAR)
        self._spare = spare - needed
        self._last[:] = angles
        self._last_time = now
        return None

    @property
    def last(self) -> NDArray[np.float64]:
        """The last accepted command (n,) [rad]; a view."""
        return self._last

    def _refuse(self, refusal: Refusal) -> Refusal:
        self.refused[refusal] += 1
        return refusal

    def _possible(self, q: ArrayLike) -> list[float] | Refusal:
        """Return joint angles that the arm has, or what is wrong with them."""
        try:
            angles = np.asarray(q, dtype=float)
        except (TypeError, ValueError, OverflowError):
            return Refusal.MALFORMED
        if angles.shape != self._last.shape:
            return Refusal.MALFORMED
        # A few floats one by one are judged faster than as an array.
        asked: list[float] = angles.tolist()
        if not all(map(isfinite, asked)):
            return Refusal.NOT_FINITE
        if any(map(gt, asked, self._highest)) or any(map(lt, asked, self._lowest)):
            return Refusal.OUT_OF_RANGE
        return asked
