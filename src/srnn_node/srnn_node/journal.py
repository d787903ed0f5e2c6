# SPDX-License-Identifier: Apache-2.0
"""Tells what a node has acted on, a few times a second."""

from collections.abc import Callable
import time

import numpy as np

from srnn_msgs_py.journal import Deed, Journal, row

AGE_S = 0.2
"""Rows are published together once the oldest is this old [s]."""

MOST = 200
"""Rows that are published together at most."""

KEPT = 2000
"""Rows kept while nothing can be published; the oldest go first, and are missed in the bag."""


class JournalWriter:
    """Collects the rows of a journal and publishes them in parts."""

    def __init__(
        self,
        publish: Callable[[Journal], None],
        session: int,
        is_open: Callable[[], bool] = lambda: True,
    ) -> None:
        """Begin a journal.

        Args:
            publish: told every part of it.
            session: when it began [ns of system time].
            is_open: tells whether something can be published now.

        """
        self._publish = publish
        self._is_open = is_open
        self._session = session
        self._index = 0
        self._rows: list[tuple[int, int, int, int, int]] = []
        self._oldest = 0.0

    def note(
        self,
        deed: Deed,
        first: int = 0,
        second: int = 0,
        time_s: float = 0.0,
        until_s: float = 0.0,
    ) -> None:
        """Take in a deed; see `srnn_msgs_py.journal.Deed` for what the numbers mean."""
        now = time.monotonic()
        if not self._rows:
            self._oldest = now
        self._rows.append(row(deed, first, second, time_s, until_s))
        if now - self._oldest >= AGE_S or len(self._rows) >= MOST:
            self.flush()

    def flush(self) -> None:
        """Publish what has not been published, as soon as that is possible."""
        if not self._is_open():
            missed = len(self._rows) - KEPT
            if missed > 0:
                del self._rows[:missed]
                self._index += missed
            return
        for begin in range(0, len(self._rows), MOST):
            rows = np.array(self._rows[begin : begin + MOST], dtype=np.int64)
            self._publish(Journal(self._session, self._index, rows))
            self._index += len(rows)
        self._rows = []
