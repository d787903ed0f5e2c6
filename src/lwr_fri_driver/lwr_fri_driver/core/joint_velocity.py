# SPDX-License-Identifier: Apache-2.0
"""Joint velocities, which the controller does not send, from the angles it does."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class JointVelocity:
    """Difference quotient of the angles through a first-order low-pass."""

    def __init__(self, cycle: float, time_constant: float) -> None:
        """Wait for the first angles.

        Args:
            cycle: time between two packets [s].
            time_constant: of the low-pass [s]; 0 for none.

        """
        self._cycle = cycle
        self._time_constant = time_constant
        self._last: Array | None = None
        self._velocity = np.zeros(7)

    def update(self, position: Array, cycles: int) -> Array:
        """Return the velocities (7,) [rad/s]; a view that the next call changes.

        Args:
            position: (7,) joint angles [rad].
            cycles: that have passed since the last ones, 1 if no packet is missing.

        """
        if self._last is not None:
            elapsed = cycles * self._cycle
            quotient = (position - self._last) / elapsed
            gain = elapsed / (self._time_constant + elapsed)
            self._velocity += gain * (quotient - self._velocity)
        self._last = position.copy()
        return self._velocity
