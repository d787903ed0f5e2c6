# SPDX-License-Identifier: Apache-2.0
"""What executes segments on simulated time, whatever it is."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from lwr_tracking.core.execution import Finished
from srnn_msgs_py.result import SegmentResult
from srnn_msgs_py.segment import Segment


class World(Protocol):
    """A tracker with something that it moves, and the obstacles of a scene around it."""

    @property
    def time(self) -> float:
        """Simulated time [s]."""

    @property
    def tip(self) -> NDArray[np.float64]:
        """Measured tip (2,) in `srnn_workspace` [m]."""

    @property
    def force_peak(self) -> float | None:
        """Largest low-passed true contact force [N]; None where there are no forces."""

    def advance(self) -> tuple[Finished, ...]:
        """Advance by one cycle of 4 ms and return the segments that are over."""

    def offer(self, segment: Segment) -> SegmentResult | None:
        """Ask for a segment to be executed next; return its result if it is refused."""

    def set_segment(self, number: int) -> None:
        """Let the obstacles of segment `number` appear and the others vanish."""
