# SPDX-License-Identifier: Apache-2.0
"""How often the answer comes within the cycle, on the loopback: the driver's process alone.

Run: .venv/bin/python bench/fri_timing.py [--seconds S] [--cycles MS [MS ...]] [--out FILE]

The exit code is 1 if fewer than 99.9 % of the answers came in time at 5 ms or 10 ms with
real-time priority on a machine with nothing else to do.
"""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import islice
import os
from pathlib import Path
import socket
import struct
import subprocess
import sys
import time

import numpy as np
from numpy.typing import NDArray

from lwr_fri_driver.core.datagram import Head
from lwr_fri_driver.core.measurement import LAYOUT, Interface, Measurement
from lwr_fri_driver.core.parameters import DriverParameters, LinkParameters
from lwr_fri_driver.core.words import MEASUREMENT_ID, MEASUREMENT_SIZE, FriState, Quality
from lwr_fri_driver.loop_client import LoopClient
from lwr_fri_driver.loop_process import LoopParameters
from lwr_fri_driver.udp_loop import SO_TIMESTAMPNS
from srnn_node.realtime import VARIABLE, prefer_thread

sys.path.insert(0, str(Path(__file__).parents[1] / 'test'))
from busy_loops import busy_loops

PEER_PRIORITY = 70
"""The controller must not be what is late."""

HELD_UP = 0.1
"""A peer that is later than this share of a cycle counts its cycles from then on."""

PERCENTILES = (50.0, 99.0, 99.9, 100.0)
ECHO = """
import os, socket
os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(60))
echo = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
echo.bind(('127.0.0.1', 0))
print(echo.getsockname()[1], flush=True)
while True:
    data, peer = echo.recvfrom(2048)
    echo.sendto(bytes(2) + data[:2] + bytes(372), peer)
"""
"""What the machine can do: an answer without a thought."""

PROMISE = 0.999
PROMISED_MS = (5.0, 10.0)
REFLECTED = struct.Struct('<2xH')


def datagrams(cycle: float) -> Iterator[bytes]:
    """Return measurements of an arm in monitor mode, one after the other."""
    interface = Interface(
        state=FriState.MONITOR, quality=Quality.PERFECT, measurement_period=cycle,
        command_period=cycle, safety_limits=1.0,
    )  # fmt: skip
    base = Measurement(interface=interface)
    sequence = 0
    while True:
        head = Head(sequence, 0, MEASUREMENT_SIZE, MEASUREMENT_ID)
        yield LAYOUT.pack(replace(base, head=head))
        sequence = (sequence + 1) % 65536


def delays(port: int, cycle: float, seconds: float) -> NDArray[np.float64]:
    """Return the time from each packet to its answer [s], infinite where none came in time."""
    count = round(seconds / cycle)
    sent, answered = np.zeros(count), np.full(count, np.inf)
    packets = list(islice(datagrams(cycle), count))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as peer:
        peer.connect(('127.0.0.1', port))
        peer.setblocking(False)
        peer.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        due = time.monotonic()
        for n, packet in enumerate(packets):
            due += cycle
            time.sleep(max(due - time.monotonic(), 0.0))
            if time.monotonic() - due > HELD_UP * cycle:
                # No controller sends two packets at once because it was held up itself.
                due = time.monotonic()
            _collect(peer, n, answered)
            sent[n] = 1e-9 * time.time_ns()
            peer.send(packet)
        time.sleep(max(cycle, 0.1))
        _collect(peer, count, answered)
    return answered - sent


def _collect(peer: socket.socket, sent: int, answered: NDArray[np.float64]) -> None:
    """Note when the kernel took each answer, whenever it is looked at."""
    while True:
        try:
            data, ancillary, *_ = peer.recvmsg(1024, 64)
        except OSError:
            return
        (reflected,) = REFLECTED.unpack_from(data)
        number = (sent - 1) - ((sent - 1 - reflected) % 65536)
        seconds, nanoseconds = struct.unpack('@qq', ancillary[0][2])
        answered[number] = seconds + 1e-9 * nanoseconds


def measure(cycle: float, priority: bool, busy: bool, seconds: float) -> NDArray[np.float64]:
    """Return delays as `delays` does, with the driver's process as it would run."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(('127.0.0.1', 0))
        port = probe.getsockname()[1]
    link = LinkParameters(port=port, cycle=cycle)
    os.environ[VARIABLE] = '' if priority else '0'
    client = LoopClient(LoopParameters(driver=DriverParameters(link=link)))
    try:
        with busy_loops((os.cpu_count() or 1) if busy else 0), at_priority(PEER_PRIORITY):
            return delays(port, cycle, seconds)
    finally:
        client.close()


def measure_echo(cycle: float, seconds: float) -> NDArray[np.float64]:
    """Return delays of the least that a Python process can do, with real-time priority."""
    with subprocess.Popen([sys.executable, '-c', ECHO], stdout=subprocess.PIPE) as echo:
        assert echo.stdout is not None
        try:
            port = int(echo.stdout.readline())
            with at_priority(PEER_PRIORITY):
                return delays(port, cycle, seconds)
        finally:
            echo.kill()


@contextmanager
def at_priority(priority: int) -> Iterator[None]:
    """Have a real-time priority for a while; what was started before has none."""
    granted = prefer_thread(priority, {})
    if not granted:
        print('the peer got no SCHED_FIFO: its own delays count as well', file=sys.stderr)
    try:
        yield
    finally:
        if granted:
            prefer_thread(0, {})


def main() -> int:
    """Measure, and print or write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--seconds', type=float, default=60.0, help='default: %(default)s')
    parser.add_argument('--cycles', type=float, nargs='+', default=[2.0, 4.0, 5.0, 10.0],
                        metavar='MS', help='default: 2 4 5 10')  # fmt: skip
    parser.add_argument('--out', type=Path, metavar='FILE', help='where the table is written')
    choice = parser.parse_args()
    names = ' | '.join(f'p{p:g}' if p < 100.0 else 'longest' for p in PERCENTILES)
    lines = [
        '# Answers of the FRI driver within the cycle',
        '',
        f'`bench/fri_timing.py --seconds {choice.seconds:g}`, {os.cpu_count()} processors, the '
        f'peer with SCHED_FIFO {PEER_PRIORITY}.',
        'Delays from the packet of the peer to the answer in its socket, on the loopback [ms].',
        '"Busy" is one endless loop per processor beside it; "echo" is a process with SCHED_FIFO',
        'that answers without a thought: what the machine can do. No answer at all counts as the',
        'whole time.',
        '',
        f'| cycle | priority | machine | answers in time | {names} |',
        f'|---|---|---|---|{"---|" * len(PERCENTILES)}',
    ]
    kept = True

    def tell(cycle_ms: float, what: str, found: NDArray[np.float64]) -> float:
        share = float((found < 1e-3 * cycle_ms).mean())
        finite = np.where(np.isfinite(found), found, choice.seconds)
        times = ' | '.join(f'{1e3 * value:.2f}' for value in np.percentile(finite, PERCENTILES))
        lines.append(f'| {cycle_ms:g} ms | {what} | {share:.3%} | {times} |')
        print(lines[-1], flush=True)
        return share

    for busy in (False, True):
        for priority in (True, False):
            for cycle_ms in choice.cycles:
                found = measure(1e-3 * cycle_ms, priority, busy, choice.seconds)
                what = f'{"SCHED_FIFO" if priority else "none"} | {"busy" if busy else "quiet"}'
                share = tell(cycle_ms, what, found)
                if priority and not busy and cycle_ms in PROMISED_MS:
                    kept &= share >= PROMISE
    for cycle_ms in choice.cycles:
        tell(cycle_ms, 'echo | quiet', measure_echo(1e-3 * cycle_ms, choice.seconds))
    text = '\n'.join(lines) + '\n'
    if choice.out:
        choice.out.write_text(text, encoding='utf-8')
    return 0 if kept else 1


if __name__ == '__main__':
    raise SystemExit(main())
