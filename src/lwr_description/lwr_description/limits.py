# SPDX-License-Identifier: Apache-2.0
"""What the joints of an arm may do at most; of the LWR 4+: (7,), FRI order, read-only."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


def read_only(*values: float) -> NDArray[np.float64]:
    """Return an array that nobody can change."""
    array = np.array(values)
    array.flags.writeable = False
    return array


class JointLimits(NamedTuple):
    """Limits of n joints, in the order of their description; read-only.

    Attributes:
        position_min: (n,) smallest joint angles [rad].
        position_max: (n,) largest joint angles [rad].
        velocity_max: (n,) largest joint speeds [rad/s].
        torque_max: (n,) largest joint torques of either sign [Nm].

    """

    position_min: NDArray[np.float64]
    position_max: NDArray[np.float64]
    velocity_max: NDArray[np.float64]
    torque_max: NDArray[np.float64]


POSITION_MAX = read_only(*np.radians([170.0, 120.0, 170.0, 120.0, 170.0, 120.0, 170.0]))
"""Largest joint angle of either sign [rad]."""

VELOCITY_MAX = read_only(1.91986, 1.91986, 2.23402, 2.23402, 3.56047, 3.21141, 3.21141)
"""Largest joint speed [rad/s]."""

TORQUE_MAX = read_only(176.0, 176.0, 100.0, 100.0, 100.0, 38.0, 38.0)
"""Largest joint torque of either sign [Nm]."""
