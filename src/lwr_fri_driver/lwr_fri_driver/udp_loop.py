# SPDX-License-Identifier: Apache-2.0
"""Answers the controller over UDP, whatever the node does meanwhile."""

import select
import socket
import struct
import time

import numpy as np

from lwr_fri_driver.core.connection import Connection
from lwr_fri_driver.core.joint_velocity import JointVelocity
from lwr_fri_driver.core.parameters import DriverParameters
from lwr_fri_driver.core.peer import Address, Peer
from lwr_fri_driver.core.phase import ENGAGED, Phase
from lwr_fri_driver.core.reports import MAX_SIZE, Sample, Wish, status_of, unpack_wish

REPORT_S = 0.5
"""The node hears of the conversation this often, and whenever its phase changes [s]."""

FAREWELL = 100
"""Packets that are still mirrored after command mode has ended and the node is gone."""

LAST_S = 5.0
"""The loop outlives the node by no more than this [s]."""

MOST_PACKETS = 64
"""Packets looked at in a row; a flood of them must not keep the node's wishes out."""

_WELCOME = 1 << 12
"""Longer packets are cut off, and so malformed."""

SO_TIMESTAMPNS = 35
_TIMESPEC = struct.Struct('@qq')


class UdpLoop:
    """One thread, two sockets: the controller's packets first, the node's wishes between them.

    Every packet is answered at once with what the connection holds ready; neither ROS nor
    the node can delay that. Without the node the arm comes to rest and command mode ends.
    """

    def __init__(
        self, udp: socket.socket, node: socket.socket, connection: Connection,
        parameters: DriverParameters, scheduling: str,
    ) -> None:
        """Take over both sockets.

        Args:
            udp: bound to the port that the controller sends to.
            node: where the node's messages come from, and reports go to.
            connection: the conversation.
            parameters: of the driver.
            scheduling: how this process is scheduled, for a person.

        """
        udp.setblocking(False)
        node.setblocking(False)
        udp.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self._udp, self._node, self._connection = udp, node, connection
        self._scheduling = scheduling
        self._peer = Peer(parameters.link.controller)
        self._time_out = parameters.link.time_out
        self._velocity = JointVelocity(
            parameters.link.cycle, parameters.control.velocity_time_constant
        )
        self._poll = select.poll()
        self._poll.register(udp, select.POLLIN)
        self._poll.register(node, select.POLLIN)
        self._next_report = 0.0
        self._told: Phase | None = None
        self._orphaned_at: float | None = None
        self._farewell = FAREWELL
        self._silent = True

    @property
    def finished(self) -> bool:
        """Tell whether the node is gone and the controller needs no answers any more."""
        if self._orphaned_at is None:
            return False
        late = time.monotonic() - self._orphaned_at > LAST_S
        return late or self._silent or self._farewell <= 0

    def turn(self) -> None:
        """Wait for packets and wishes, no longer than it takes to notice a silence."""
        ready = {fd for fd, _ in self._poll.poll(500.0 * self._time_out)}
        if self._node.fileno() in ready:
            self._hear_node()
        if self._udp.fileno() in ready:
            self._hear_controller()
        now = time.monotonic()
        self._silent = self._connection.silence(now)
        if self._silent:
            self._peer.forget()
        self._tell(now)

    def _hear_controller(self) -> None:
        """Look at all packets that wait; the newest one alone can still be answered in time."""
        connection = self._connection
        answer, stamp_ns = None, 0
        for _ in range(MOST_PACKETS):
            packet = self._receive()
            if packet is None:
                break
            data, address, arrived_ns = packet
            if not self._peer.admits(address):
                continue
            malformed = connection.malformed
            waited = max(1e-9 * (time.time_ns() - arrived_ns), 0.0)
            candidate = connection.answer(data, time.monotonic() - waited)
            if connection.malformed == malformed:
                self._peer.adopt(address)
            if candidate is not None:
                answer, stamp_ns = candidate, arrived_ns
        if answer is None or self._peer.address is None:
            return
        try:
            self._udp.sendto(answer, self._peer.address)
        except OSError:
            return  # The link is down: to the controller that is an answer lost.
        connection.link.answered(1e-9 * (time.time_ns() - stamp_ns))
        self._pass_on(stamp_ns)
        if self._orphaned_at is not None and connection.phase not in ENGAGED:
            self._farewell -= 1

    def _receive(self) -> tuple[bytes, Address, int] | None:
        """Return a packet, who has sent it, and when it arrived [ns of system time]."""
        try:
            data, ancillary, _, address = self._udp.recvmsg(_WELCOME, 64)
        except OSError:
            return None
        for level, kind, content in ancillary:
            if (level, kind) == (socket.SOL_SOCKET, SO_TIMESTAMPNS):
                seconds, nanoseconds = _TIMESPEC.unpack(content)
                return data, address, seconds * 1_000_000_000 + nanoseconds
        return data, address, time.time_ns()

    def _pass_on(self, stamp_ns: int) -> None:
        """Report what was measured while commands move the arm."""
        connection, measurement = self._connection, self._connection.measurement
        assert measurement is not None
        data = measurement.data
        position = np.array(data.joint_position)
        velocity = self._velocity.update(position, connection.sequence.elapsed)
        if connection.commanding:
            values = np.array([position, velocity, data.joint_torque, data.external_torque])
            self._send(Sample(stamp_ns, values).pack())

    def _hear_node(self) -> None:
        while True:
            try:
                message = self._node.recv(MAX_SIZE)
            except BlockingIOError:
                return
            except OSError:
                message = b''
            if not message:
                self._orphan()
                return
            wish = unpack_wish(message)
            now = time.monotonic()
            if not isinstance(wish, Wish):
                self._connection.command(wish, now)
            elif wish is Wish.RESET:
                self._connection.reset(now)
            else:
                self._connection.request(wish is Wish.START)

    def _orphan(self) -> None:
        self._orphaned_at = time.monotonic()
        self._poll.unregister(self._node)
        self._connection.request(False)

    def _tell(self, now: float) -> None:
        connection = self._connection
        if connection.phase is self._told and now < self._next_report:
            return
        self._told, self._next_report = connection.phase, now + REPORT_S
        status = status_of(connection)
        status.values.update(foreign=self._peer.foreign, scheduling=self._scheduling)
        self._send(status.pack())

    def _send(self, message: bytes) -> None:
        """Report to the node; one that does not listen misses it."""
        if self._orphaned_at is not None:
            return
        try:
            self._node.send(message)
        except OSError:
            return  # Its end, if it is one, is read by `_hear_node`.
