# SPDX-License-Identifier: Apache-2.0
"""One direction of a network that loses, doubles and delays packets."""

import heapq
from itertools import count

import numpy as np

from lwr_sim_bridge.fri.parameters import LinkFaultParameters


class LinkFaults:
    """Takes packets in and hands out those that have arrived; time is an argument."""

    def __init__(self, parameters: LinkFaultParameters, rng: np.random.Generator) -> None:
        """Begin with nothing on the way."""
        self.parameters = parameters
        self._rng = rng
        self._numbers = count()
        self._on_the_way: list[tuple[float, int, bytes]] = []

    def take(self, packet: bytes, now: float) -> None:
        """Take in a packet that is sent at `now` [s]."""
        faults = self.parameters
        if self._rng.random() < faults.loss:
            return
        for _ in range(2 if self._rng.random() < faults.duplicates else 1):
            arrival = now + faults.jitter * self._rng.random()
            heapq.heappush(self._on_the_way, (arrival, next(self._numbers), packet))

    def arrived(self, now: float) -> list[tuple[bytes, float]]:
        """Return the packets that have arrived by `now` [s], each with its time [s]."""
        packets = []
        while self._on_the_way and self._on_the_way[0][0] <= now:
            arrival, _, packet = heapq.heappop(self._on_the_way)
            packets.append((packet, arrival))
        return packets

    @property
    def next(self) -> float:
        """Time at which the next packet arrives [s], infinite without one."""
        return self._on_the_way[0][0] if self._on_the_way else np.inf
