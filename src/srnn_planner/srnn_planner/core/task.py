# SPDX-License-Identifier: Apache-2.0
"""The task: way points visited one after another, again and again."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.errors import TaskError


@dataclass(frozen=True, eq=False)
class WaypointTask:
    """Progress along a closed sequence of way points; a value, advanced by `after`.

    Attributes:
        waypoints: (M, d) in units.
        reach_radius: a way point counts as reached within this distance [units].
        active: index of the way point that attracts now.
        reached: number of way points reached so far.

    """

    waypoints: NDArray[np.float64]
    reach_radius: float
    active: int = 0
    reached: int = 0

    def __post_init__(self) -> None:
        """Refuse tasks that cannot be followed."""
        if self.waypoints.ndim != 2 or len(self.waypoints) == 0:
            raise TaskError('waypoints: at least one is needed')
        if not np.isfinite(self.waypoints).all() or np.abs(self.waypoints).max() > 1.0:
            raise TaskError('waypoints: every one must lie inside the workspace')
        if not self.reach_radius > 0.0:
            raise TaskError(f'reach_radius = {self.reach_radius}: must be > 0')

    @property
    def laps(self) -> int:
        """Number of times that all way points were visited."""
        return self.reached // len(self.waypoints)

    @property
    def target(self) -> NDArray[np.float64]:
        """Position (d,) of the active way point [units]."""
        return np.asarray(self.waypoints[self.active])

    def after(self, position: NDArray[np.float64]) -> 'WaypointTask':
        """Return the task after a segment has ended at `position` (d,) [units]."""
        if np.linalg.norm(position - self.target) > self.reach_radius:
            return self
        return replace(
            self, active=(self.active + 1) % len(self.waypoints), reached=self.reached + 1
        )
