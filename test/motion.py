# SPDX-License-Identifier: Apache-2.0
"""How the simulated arm of a running graph has moved, for a verdict on it."""

import numpy as np
from watched_graph import Watched

from lwr_description import Kinematics, Mount

KINEMATICS = Kinematics(Mount())
CYCLE_S = 0.004
CYCLES = 5

STILL = 0.0005
"""Closer than this to where it stays the tip counts as being there [m]."""

RECENT_NS = 3 * 10**9
"""Segments that were sent so long before may still be under way."""

WAITING_NS = 5 * 10**8
"""A segment may have waited so long for the one before it to end."""


class Motion:
    """What the arm did since a time [ns], out of its joint states.

    Attributes:
        stamps: (n,) times of the joint states [ns].
        tips: (n, 3) tip [m].
        speed: fastest that the tip moved, over 20 ms [m/s].

    """

    def __init__(self, watched: Watched, since: int, until: int | None = None) -> None:
        samples = [
            sample for sample in watched.joints
            if sample[0] >= since and (until is None or sample[0] < until)
        ]  # fmt: skip
        self.stamps = np.array([stamp for stamp, _ in samples])
        self.tips = np.array([KINEMATICS.tip(position) for _, position in samples])
        self.speed = self._fastest()
        self._heard = np.ones(len(samples), bool)
        self._unheard = watched.unheard(since - RECENT_NS)
        for path in self._unheard:
            after = self.stamps - path.stamp_ns
            self._heard &= (after < 0) | (after > 1e9 * path.times[-1] + WAITING_NS)
        self._planned = np.vstack([
            s.positions[:, :2] for s in watched.segments if s.stamp_ns >= since - RECENT_NS
        ])

    def off_path(self) -> float:
        """Return how far the tip was from all that was planned meanwhile, at most [m].

        What was planned unheard is not known: while it was executed nothing is said.
        """
        # After a restart the first may be missed, and the one that waited behind it.
        assert len(self._unheard) <= 2
        farthest, tips = 0.0, self.tips[self._heard, :2]
        for part in np.array_split(tips, 1 + len(tips) // 500):
            away = np.linalg.norm(part[:, None] - self._planned[None], axis=2).min(axis=1)
            farthest = max(farthest, away.max(initial=0.0))
        return float(farthest)

    def travel(self) -> float:
        """Return how far the tip got from where it was at first [m]."""
        return float(np.linalg.norm(self.tips - self.tips[0], axis=1).max())

    def rest_ms(self) -> float:
        """Return how long it took until the tip stayed where it is at the end [ms]."""
        away = np.linalg.norm(self.tips - self.tips[-1], axis=1)
        moving = np.flatnonzero(away > STILL)
        return 1e-6 * float(self.stamps[moving.max(initial=0)] - self.stamps[0])

    def _fastest(self) -> float:
        """Return the highest speed over 20 ms.

        The arm may be simulated late, and then for a while faster than time goes by: the longer
        of both times counts.
        """
        moved = np.linalg.norm(self.tips[CYCLES:] - self.tips[:-CYCLES], axis=1)
        seconds = 1e-9 * (self.stamps[CYCLES:] - self.stamps[:-CYCLES])
        return float((moved / np.maximum(seconds, CYCLES * CYCLE_S)).max(initial=0.0))
