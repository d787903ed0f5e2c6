# SPDX-License-Identifier: Apache-2.0
"""What was commanded a fixed time ago: what the arm should show now."""

from collections import deque

Entry = tuple[float, float, float, float]


class DelayLine:
    """Delays the reference (x, y, z [m]) and its path clock [s] by a fixed time."""

    def __init__(self, delay: float) -> None:
        """Delay by `delay` seconds."""
        self._delay = delay
        self._time = 0.0
        self._entries: deque[tuple[float, Entry]] = deque()

    def fill(self, entry: Entry) -> None:
        """Forget the past: the delayed value is `entry` until something new is older."""
        self._entries.clear()
        self._entries.append((self._time, entry))

    def push(self, dt: float, entry: Entry) -> Entry:
        """Add the value `dt` seconds after the last one and return the delayed value."""
        self._time += dt
        entries = self._entries
        entries.append((self._time, entry))
        due = self._time - self._delay
        while len(entries) > 1 and entries[1][0] <= due:
            entries.popleft()
        t0, old = entries[0]
        if len(entries) == 1 or due <= t0:
            return old
        t1, new = entries[1]
        w = (due - t0) / (t1 - t0)
        return (
            old[0] + w * (new[0] - old[0]),
            old[1] + w * (new[1] - old[1]),
            old[2] + w * (new[2] - old[2]),
            old[3] + w * (new[3] - old[3]),
        )
