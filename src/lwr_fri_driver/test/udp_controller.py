# SPDX-License-Identifier: Apache-2.0
"""A controller on a UDP socket, in a thread: it obeys at once and is where it was told to be."""

import socket
import threading
import time

from scripted_controller import COMMANDING, CYCLE, MONITOR, Answer, ScriptedController


class UdpController:
    """As a context manager it sends once a cycle, and starts and stops as it is asked.

    Attributes:
        answers: all that came, oldest first.
        says: fields to change in the next packet.
        silent: whether it keeps quiet.

    """

    def __init__(self, port):
        self.answers = []
        self.says = {}
        self.silent = False
        self._krc = ScriptedController()
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.connect(('127.0.0.1', port))
        self._socket.settimeout(CYCLE)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._stop.set()
        self._thread.join()
        self._socket.close()

    def _run(self):
        due = time.monotonic()
        while not self._stop.is_set():
            due += CYCLE
            if not self.silent:
                self._cycle()
            time.sleep(max(due - time.monotonic(), 0.0))

    def _cycle(self):
        self._krc.say(**self.says)
        self._krc.sequence += 1
        try:
            self._socket.send(self._krc.datagram())
            answer = Answer(self._socket.recv(4096))
        except OSError:
            return
        self.answers.append(answer)
        started = answer.ints[1] == 1
        self._krc.say(state=COMMANDING if started else MONITOR)
        if started:
            self._krc.obey(answer)
