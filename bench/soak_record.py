# SPDX-License-Identifier: Apache-2.0
"""What is written down about the processes and the messages of a long run; pure."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
import re
import resource

import numpy as np
from numpy.typing import NDArray

from lwr_description import POSITION_MAX
from srnn_msgs_py.health import Health, HealthLevel

MB = 1e6


def resident_mb(pid: int) -> float:
    """Return the memory that a process has in RAM [MB]."""
    pages = int(Path(f'/proc/{pid}/statm').read_text().split()[1])
    return pages * resource.getpagesize() / MB


def growth_mb(times: Sequence[float], sizes: Sequence[float], warm_up: float) -> float:
    """Return how much a size has grown since the warm-up, along the line that fits it best.

    Args:
        times: when it was looked at, increasing [s].
        sizes: what it was [MB].
        warm_up: what was before does not count [s].

    """
    t, y = np.array(times), np.array(sizes)
    late = t >= warm_up
    if late.sum() < 2:
        return 0.0
    slope = np.polyfit(t[late], y[late], 1)[0]
    return float(slope * (t[late][-1] - t[late][0]))


@dataclass
class Heartbeat:
    """The health that one node has reported.

    Attributes:
        count: how often it has.
        gap: longest time between two reports [s].
        troubles: reports above OK, by their words, with # for any number.
        first: figures of its first report while active.
        values: figures of its last one.

    """

    count: int = 0
    gap: float = 0.0
    troubles: Counter[str] = field(default_factory=Counter)
    first: dict[str, float | int | str] = field(default_factory=dict)
    values: dict[str, float | int | str] = field(default_factory=dict)
    _last: float | None = None

    def beat(self, health: Health, now: float) -> None:
        """Take in a report that came at `now` [s]."""
        if self._last is not None:
            self.gap = max(self.gap, now - self._last)
        self._last = now
        self.count += 1
        if health.level is not HealthLevel.OK:
            words = re.sub(r'\d+(\.\d+)?', '#', health.message)
            self.troubles[f'{health.level.name} {words}'] += 1
        self.values = dict(health.values)
        self.first = self.first or self.values

    def silence(self, now: float) -> None:
        """Count the time since the last report as well [s]."""
        if self._last is not None:
            self.gap = max(self.gap, now - self._last)

    def figure(self, name: str) -> float:
        """Return a figure of the last report; 0 if there is none."""
        return float(self.values.get(name, 0.0))


@dataclass
class JointRecord:
    """What was wrong with the measured joint angles.

    Attributes:
        samples: joint states heard.
        not_finite: those with a number that is none.
        beyond: those with an angle beyond its limit.

    """

    samples: int = 0
    not_finite: int = 0
    beyond: int = 0

    def add(self, position: NDArray[np.float64]) -> None:
        """Take in joint angles (7,) [rad]."""
        self.samples += 1
        if not np.isfinite(position).all():
            self.not_finite += 1
        elif (np.abs(position) > POSITION_MAX).any():
            self.beyond += 1
