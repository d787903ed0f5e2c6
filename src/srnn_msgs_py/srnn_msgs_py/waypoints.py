# SPDX-License-Identifier: Apache-2.0
"""The way points that the user wants visited."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.segment import FRAME


@dataclass(frozen=True, eq=False)
class Waypoints:
    """A closed tour of points.

    Attributes:
        stamp_ns: time of the order [ns of ROS time].
        points: (N, 3) in `frame` [m]; z is 0 in the plane of the task.
        frame: name of the frame the numbers are in.

    """

    stamp_ns: int
    points: NDArray[np.float64]
    frame: str = FRAME
