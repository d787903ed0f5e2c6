# SPDX-License-Identifier: Apache-2.0
"""What the motion of the arm must keep to, whatever is done to the graph."""

from fault_ledger import Injection
from motion import Motion
from watched_graph import Watched

from srnn_msgs_py.result import ResultCode

OFF_PATH_MM = 5.0
SPEED = 0.25

VELOCITY = 0.15
"""Segments are up to 0.05 m/s faster than this where one joins the other [m/s]."""

LOOSELY = 5.0
"""The wall clock of a busy machine is not the one that deadlines are for."""


def keeps_to_the_path(watched: Watched, since: int, entry: Injection) -> None:
    """Demand that the arm has been near its planned paths, not too fast, and untroubled.

    It must be under way: this process may be late to hear, and has heard all that was sent
    until now when it hears of what was sent later.
    """
    until = watched.now()
    watched.first_executed(until)
    motion = Motion(watched, since, until)
    entry.deviation_mm = 1e3 * motion.off_path()
    entry.speed = motion.speed
    assert entry.deviation_mm <= OFF_PATH_MM
    assert entry.speed <= SPEED
    codes = {r.code for r in watched.results if r.stamp_ns >= since}
    assert not codes & {ResultCode.FAULT, ResultCode.BLOCKED}


def nearly_stands_still(watched: Watched, since: int, entry: Injection, bound_mm: float) -> Motion:
    """Demand that the arm has not gone far, nor fast."""
    motion = Motion(watched, since)
    entry.deviation_mm = max(entry.deviation_mm or 0.0, 1e3 * motion.travel())
    entry.speed = max(entry.speed or 0.0, motion.speed)
    assert entry.deviation_mm <= bound_mm
    assert entry.speed <= SPEED
    return motion
