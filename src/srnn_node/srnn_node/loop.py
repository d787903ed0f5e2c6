# SPDX-License-Identifier: Apache-2.0
"""The main loop of a node: events and ticks in one thread."""

from typing import Protocol

LONGEST_WAIT_S = 0.05
"""Signal handlers of Python run only between two waits, so no wait is longer than this."""


class Ticking(Protocol):
    """What the loop asks of a node."""

    @property
    def active(self) -> bool:
        """Tell whether ticks are wanted."""

    def seconds_to_tick(self) -> float | None:
        """Return the time to the next tick [s], <= 0 when it is due, None for no tick."""

    def on_tick(self) -> None:
        """Do what is due."""


class Spinning(Protocol):
    """What the loop asks of an executor."""

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Handle one event, or return after the time-out [s]."""


class Loop:
    """Alternates between ticks and events; neither can starve the other.

    EventsExecutor.spin() without a time-out busy-waits in the published wheels, and
    timers of rclpy skip periods under load: hence bounded waits, and ticks that the
    node schedules itself.
    """

    def __init__(self, node: Ticking, executor: Spinning) -> None:
        """Serve `node` with the events of `executor`."""
        self._node = node
        self._executor = executor

    def turn(self) -> None:
        """Run the tick if it is due, then handle at most one event."""
        wait = self._wait()
        if wait <= 0.0:
            self._node.on_tick()
            wait = self._wait()
        self._executor.spin_once(timeout_sec=min(max(wait, 0.0), LONGEST_WAIT_S))

    def _wait(self) -> float:
        wait = self._node.seconds_to_tick() if self._node.active else None
        return LONGEST_WAIT_S if wait is None else wait
