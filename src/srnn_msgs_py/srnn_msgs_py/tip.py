# SPDX-License-Identifier: Apache-2.0
"""Where the tip of the tool is."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.segment import FRAME


@dataclass(frozen=True, eq=False)
class TipPosition:
    """The measured tip.

    Attributes:
        stamp_ns: time of measurement [ns of ROS time].
        position: (3,) in `frame` [m].
        frame: name of the frame the numbers are in.

    """

    stamp_ns: int
    position: NDArray[np.float64]
    frame: str = FRAME
