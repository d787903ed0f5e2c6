# SPDX-License-Identifier: Apache-2.0
"""The name of a sender: when it sent its first message."""


class Source:
    """One sender; the later it began to send, the greater its number."""

    def __init__(self) -> None:
        """Begin with the first call of `epoch`."""
        self._epoch = 0

    def epoch(self, now_ns: int) -> int:
        """Return the number of the sender: `now_ns` [ns of the system clock] of the first call."""
        self._epoch = self._epoch or max(now_ns, 1)
        return self._epoch
