# SPDX-License-Identifier: Apache-2.0
"""What the joints of the LWR 4+ may do at most; arrays of shape (7,), FRI order, read-only."""

import numpy as np
from numpy.typing import NDArray


def _limits(*values: float) -> NDArray[np.float64]:
    array = np.array(values)
    array.flags.writeable = False
    return array


POSITION_MAX = _limits(*np.radians([170.0, 120.0, 170.0, 120.0, 170.0, 120.0, 170.0]))
"""Largest joint angle of either sign [rad]."""

VELOCITY_MAX = _limits(1.91986, 1.91986, 2.23402, 2.23402, 3.56047, 3.21141, 3.21141)
"""Largest joint speed [rad/s]."""

TORQUE_MAX = _limits(176.0, 176.0, 100.0, 100.0, 100.0, 38.0, 38.0)
"""Largest joint torque of either sign [Nm]."""
