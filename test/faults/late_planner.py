# SPDX-License-Identifier: Apache-2.0
"""The planner on a host whose clock is two seconds behind; for fault tests."""

from typing import Any

from rclpy.duration import Duration
from rclpy.time import Time

from srnn_node.run import run
from srnn_planner.nodes.planner_node import PlannerNode

BEHIND_S = 2.0


class LateClock:
    """Tells what another clock told some time ago."""

    def __init__(self, clock: Any) -> None:
        """Run behind `clock`."""
        self._clock = clock

    def now(self) -> Time:
        return self._clock.now() - Duration(seconds=BEHIND_S)


class LatePlanner(PlannerNode):
    """Stamps its segments by a clock that is behind."""

    def get_clock(self) -> LateClock:
        return LateClock(super().get_clock())


if __name__ == '__main__':
    raise SystemExit(run(LatePlanner))
