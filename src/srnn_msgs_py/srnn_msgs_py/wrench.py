# SPDX-License-Identifier: Apache-2.0
"""A force and a torque at one point."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Wrench:
    """Force and torque on the tool.

    Attributes:
        stamp_ns: time of measurement [ns of ROS time].
        frame: name of the frame the numbers are in.
        force: (3,) [N].
        torque: (3,) about the origin of `frame` [Nm].

    """

    stamp_ns: int
    frame: str
    force: NDArray[np.float64]
    torque: NDArray[np.float64]
