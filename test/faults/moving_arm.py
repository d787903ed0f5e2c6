# SPDX-License-Identifier: Apache-2.0
"""An arm on its way, at random: where, whereto, how fast, and how far it has got."""

from dataclasses import dataclass
import zlib

from arm_rig import Rig, rig
import numpy as np
from segments import MS, line

from srnn_msgs_py.segment import Segment

EDGE = 0.28
SHORTEST = 0.2
RAMP = 0.3
FASTEST = 0.249
"""The gate admits up to 0.25 m/s; between the knots of a plan it is a little more [m/s]."""


@dataclass(frozen=True)
class Course:
    """A straight way through the plane.

    Attributes:
        start: where it begins [m].
        end: where it ends [m].
        speed: between the ramps [m/s].
        moment: time on the way, at full speed, until something happens [s].

    """

    start: tuple[float, float]
    end: tuple[float, float]
    speed: float
    moment: float

    @property
    def duration(self) -> float:
        """Time from the start to the end [s]."""
        return float(np.hypot(*np.subtract(self.end, self.start))) / self.speed + RAMP

    def cap(self, overshoot: float = 1.08) -> float:
        """Return the fastest that the tip may be [m/s]; it overshoots fast plans a little."""
        return max(0.25, overshoot * self.speed)

    @property
    def haste(self) -> float:
        """Factor for bounds that are promised at 0.2 m/s."""
        return max(1.0, self.speed / 0.2)

    def begin(self, **arm_parameters) -> Rig:
        """Return an arm that is on this way and has come up to the moment."""
        made = rig(start=self.start, **arm_parameters)
        assert made.tracker.offer(line(self.start, self.end, self.speed), 0.0) is None
        made.run(self.moment)
        return made

    def continued(self, rng: np.random.Generator) -> Segment:
        """Return a good segment that begins where this one ends, with the next identity."""
        while True:
            end = rng.uniform(-EDGE, EDGE, 2)
            if np.hypot(*(end - self.end)) > 0.1:
                return line(self.end, tuple(end), rng.uniform(0.05, 0.2), stamp_ns=MS + 1)


def random_course(rng: np.random.Generator) -> Course:
    """Return a way of at least 0.2 m anywhere in the plane, at 0.05 to 0.25 m/s."""
    speed = rng.uniform(0.05, FASTEST)
    while True:
        start, end = rng.uniform(-EDGE, EDGE, (2, 2))
        length = float(np.hypot(*(end - start)))
        if length >= SHORTEST:
            break
    # Before the arm slows down for the end, which takes longest when it is slow.
    moment = rng.uniform(RAMP, min(length / speed, 1.5))
    return Course(tuple(start.tolist()), tuple(end.tolist()), speed, moment)


def generator(fault: str, repeat: int) -> np.random.Generator:
    """Return the random numbers of one injection: others for every fault and repeat."""
    return np.random.default_rng([zlib.crc32(fault.encode()), repeat])


def speeds(tips: np.ndarray, period: float) -> np.ndarray:
    """Return the speed between each two of the tips (n, 3) [m], `period` [s] apart."""
    return np.linalg.norm(np.diff(tips, axis=0), axis=1) / period
