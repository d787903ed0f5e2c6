# SPDX-License-Identifier: Apache-2.0
"""SIGINT and SIGTERM as a request to stop, so that a node can still speak before it goes."""

import signal
from types import FrameType, TracebackType
from typing import Any, Self


class StopRequest:
    """Records the first SIGINT or SIGTERM while its ``with`` block runs.

    rclpy's own handlers would shut the context down at once, and with it every
    publisher. Use with ``SignalHandlerOptions.NO``, in the main thread.

    Attributes:
        name: name of the first signal that came, or None.

    """

    def __init__(self) -> None:
        """Record nothing yet."""
        self.name: str | None = None
        self._previous: dict[signal.Signals, Any] = {}

    def __enter__(self) -> Self:
        for number in (signal.SIGINT, signal.SIGTERM):
            self._previous[number] = signal.signal(number, self._record)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        for number, handler in self._previous.items():
            signal.signal(number, handler)

    def _record(self, number: int, frame: FrameType | None) -> None:
        if self.name is None:
            self.name = signal.Signals(number).name
