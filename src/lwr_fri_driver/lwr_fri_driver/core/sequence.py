# SPDX-License-Identifier: Apache-2.0
"""Which packets of the controller are new, and how many are missing."""

from enum import Enum

WRAP = 1 << 16

RESTART = 5
"""So many packets in a row that count on from an older number are a controller anew."""


class Arrival(Enum):
    """What a packet is to those before it."""

    FRESH = 'newer than all before'
    DUPLICATE = 'as the last one'
    OLD = 'overtaken by a newer one'
    RESTARTED = 'of a controller that counts anew'


class SequenceWatch:
    """Follows the counter of the sender through losses, doubles, disorder and restarts.

    Attributes:
        last: counter of the newest packet; None before the first.
        elapsed: packets that the newest one is after the one before it, 1 if none is missing.
        counts: packets by what they were.
        lost: counters that were skipped and have not come late.

    """

    def __init__(self) -> None:
        """Wait for the first packet."""
        self.last: int | None = None
        self.elapsed = 1
        self.counts = dict.fromkeys(Arrival, 0)
        self.lost = 0
        self._stale = 0
        self._stale_run = 0

    def judge(self, sequence: int) -> Arrival:
        """Take in the counter of a packet, 0 to 65535."""
        arrival = self._judge(sequence)
        self.counts[arrival] += 1
        return arrival

    def _judge(self, sequence: int) -> Arrival:
        if self.last is None:
            return self._newest(sequence, 1, Arrival.FRESH)
        ahead = (sequence - self.last) % WRAP
        if 0 < ahead < WRAP // 2:
            self.lost += ahead - 1
            return self._newest(sequence, ahead, Arrival.FRESH)
        follows = sequence == (self._stale + 1) % WRAP
        self._stale_run = self._stale_run + 1 if follows else 1
        self._stale = sequence
        if self._stale_run >= RESTART:
            return self._newest(sequence, 1, Arrival.RESTARTED)
        if ahead == 0:
            return Arrival.DUPLICATE
        self.lost = max(self.lost - 1, 0)
        return Arrival.OLD

    def _newest(self, sequence: int, elapsed: int, arrival: Arrival) -> Arrival:
        self.last, self.elapsed = sequence, elapsed
        self._stale_run = 0
        return arrival
