# SPDX-License-Identifier: Apache-2.0
"""The node's end of the process that answers the controller."""

from contextlib import suppress
import json
import os
from pathlib import Path
import select
import socket
import subprocess
import sys
import time

import numpy as np
from numpy.typing import NDArray

from lwr_fri_driver.core.phase import ENGAGED
from lwr_fri_driver.core.reports import (
    MAX_SIZE,
    Sample,
    Status,
    Wish,
    pack_command,
    unpack_report,
)
from lwr_fri_driver.errors import LoopError
from lwr_fri_driver.loop_process import LoopParameters
from srnn_config import to_mapping

WISH_S = 1.0
"""A wish must have been taken within this [s]."""

START_S = 30.0
"""The process must have reported within this [s]."""

END_S = 8.0
"""The process must have ended within this once the node has let go of it [s]."""


class LoopClient:
    """Starts the process, hands wishes over, takes reports, and notices its end.

    Attributes:
        status: the last one that was reported.
        port: UDP port that the process answers at.
        pid: of the process.

    """

    def __init__(self, parameters: LoopParameters) -> None:
        """Start the process and wait for its first report.

        Raises:
            LoopError: the port is taken, or the process does not start.

        """
        link = parameters.driver.link
        udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with udp, theirs:
            try:
                udp.bind(('', link.port))
            except OSError as error:
                self._socket.close()
                raise LoopError(f'link.port = {link.port}: {error.strerror}') from error
            self.port: int = udp.getsockname()[1]
            descriptors = udp.fileno(), theirs.fileno()
            self._process = subprocess.Popen(
                [sys.executable, '-m', 'lwr_fri_driver.loop_process', *map(str, descriptors)],
                pass_fds=descriptors, start_new_session=True,
                cwd=Path(os.sep),
            )
        self.pid = self._process.pid
        self._socket.send(json.dumps(to_mapping(parameters)).encode())
        self.status = self._first_status()
        self._heard = time.monotonic()
        self._socket.setblocking(False)

    def wish(self, wish: Wish) -> None:
        """Ask for command mode, for its end, or for a fault to be forgotten.

        Raises:
            LoopError: the process has ended, or sleeps.

        """
        self._socket.settimeout(WISH_S)
        try:
            self._socket.send(wish.value)
        except TimeoutError as error:
            raise LoopError('the process that answers the controller does not listen') from error
        except OSError as error:
            raise self._ended() from error
        finally:
            self._socket.setblocking(False)

    def command(self, q: NDArray[np.float64]) -> None:
        """Head for the joint angles `q` (7,) [rad]."""
        # If it sleeps, what is old when it wakes is not worth waiting for; its end is
        # noticed by `take`.
        with suppress(OSError):
            self._socket.send(pack_command(q))

    def take(self) -> Sample | None:
        """Take all reports that wait; return the newest measurement among them, if any.

        Raises:
            LoopError: the process has ended.

        """
        newest = None
        while True:
            try:
                message = self._socket.recv(MAX_SIZE)
            except BlockingIOError:
                return newest
            except OSError as error:
                raise self._ended() from error
            if not message:
                raise self._ended()
            report = unpack_report(message)
            if isinstance(report, Status):
                self.status, self._heard = report, time.monotonic()
            else:
                newest = report

    @property
    def silent_for(self) -> float:
        """Time since the process has last reported its status [s]."""
        return time.monotonic() - self._heard

    def wait(self, seconds: float) -> None:
        """Return when a report waits, at the latest after `seconds` [s]."""
        select.select([self._socket], [], [], max(seconds, 0.0))

    def leave(self, patience: float) -> None:
        """Ask for the end of command mode, and wait for it at most `patience` [s].

        Raises:
            LoopError: the process has ended, or sleeps.

        """
        self.wish(Wish.STOP)
        until = time.monotonic() + patience
        self.take()
        while self.status.phase in ENGAGED and time.monotonic() < until:
            self.wait(until - time.monotonic())
            self.take()

    def close(self) -> None:
        """Let go: the process brings the arm to rest, leaves command mode and ends."""
        self._socket.close()
        try:
            self._process.wait(END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _first_status(self) -> Status:
        until = time.monotonic() + START_S
        while self._process.poll() is None and time.monotonic() < until:
            self._socket.settimeout(0.1)
            try:
                message = self._socket.recv(MAX_SIZE)
            except TimeoutError:
                continue
            if not message:
                break
            report = unpack_report(message)
            if isinstance(report, Status):
                return report
        self.close()
        raise LoopError('the process that answers the controller does not start')

    def _ended(self) -> LoopError:
        return LoopError(
            f'the process that answers the controller has ended, exit code {self._process.poll()}'
        )
