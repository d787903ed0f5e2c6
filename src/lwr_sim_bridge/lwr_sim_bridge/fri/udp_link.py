# SPDX-License-Identifier: Apache-2.0
"""The emulated controller's UDP socket, with the faults of a network on both ways."""

import socket
import struct
import time

import numpy as np

from lwr_sim_bridge.fri.link_faults import LinkFaults
from lwr_sim_bridge.fri.parameters import LinkFaultParameters

_MOST = 64
"""Datagrams taken in a row; a flood must not stop the arm."""

_SO_TIMESTAMPNS = 35
_TIMESPEC = struct.Struct('@qq')


class UdpLink:
    """Sends to one peer and hears nobody else; times are those of the steady clock."""

    def __init__(
        self, address: tuple[str, int], faults: LinkFaultParameters, rng: np.random.Generator
    ) -> None:
        """Open a socket.

        Args:
            address: host and port of the peer.
            faults: of the network, each way.
            rng: of the faults.

        Raises:
            OSError: the address means nothing.

        """
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.connect(address)
        except OSError:
            self._socket.close()
            raise
        self._socket.setblocking(False)
        self._socket.setsockopt(socket.SOL_SOCKET, _SO_TIMESTAMPNS, 1)
        self._out, self._in = LinkFaults(faults, rng), LinkFaults(faults, rng)

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()

    @property
    def next(self) -> float:
        """When the next late packet has to go out [s], infinite without one."""
        return self._out.next

    def send(self, packet: bytes) -> None:
        """Send a packet now, or whenever the faults let it through."""
        self._out.take(packet, time.monotonic())
        self.flush()

    def flush(self) -> None:
        """Send late packets that are due."""
        for packet, _ in self._out.arrived(time.monotonic()):
            try:
                self._socket.send(packet)
            except OSError:
                continue  # Nobody listens there, yet or any more: a packet lost.

    def receive(self) -> list[tuple[bytes, float]]:
        """Return what has arrived, each with the time at which it did [s]."""
        for _ in range(_MOST):
            try:
                data, ancillary, *_ = self._socket.recvmsg(2048, 64)
            except BlockingIOError:
                break
            except OSError:
                continue  # Says that a packet before found nobody.
            now, waited = time.monotonic(), 0.0
            for level, kind, content in ancillary:
                if (level, kind) == (socket.SOL_SOCKET, _SO_TIMESTAMPNS):
                    seconds, nanoseconds = _TIMESPEC.unpack(content)
                    waited = time.time() - (seconds + 1e-9 * nanoseconds)
            self._in.take(data, now - max(waited, 0.0))
        return self._in.arrived(time.monotonic())
