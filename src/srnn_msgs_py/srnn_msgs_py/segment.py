# SPDX-License-Identifier: Apache-2.0
"""A planned segment and the path the arm really took: what planner and tracker share."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FRAME = 'srnn_workspace'
AXES = ('x', 'y', 'z')


@dataclass(frozen=True, eq=False)
class Segment:
    """A short planned motion with its identity.

    Attributes:
        stamp_ns: identity [ns of ROS time], strictly increasing per planner.
        times: (T,) time since the start of the segment [s]; times[0] = 0, increasing.
        positions: (T, d) tip position in `srnn_workspace` [m].
        velocities: (T, d) [m/s].
        accelerations: (T, d) [m/s^2].
        frame: name of the frame the numbers are in.

    """

    stamp_ns: int
    times: NDArray[np.float64]
    positions: NDArray[np.float64]
    velocities: NDArray[np.float64]
    accelerations: NDArray[np.float64]
    frame: str = FRAME

    @property
    def duration(self) -> float:
        """Planned execution time [s]."""
        return float(self.times[-1])


@dataclass(frozen=True, eq=False)
class ExecutedPath:
    """The measured path of one segment, at the times of its plan.

    Attributes:
        stamp_ns: identity of the segment that was executed [ns].
        times: (T,) the times of the plan [s].
        positions: (T, d) measured tip position in `srnn_workspace` [m]; after a
            contact it stays where the arm stopped.

    """

    stamp_ns: int
    times: NDArray[np.float64]
    positions: NDArray[np.float64]
    frame: str = FRAME
