# SPDX-License-Identifier: Apache-2.0
"""Facts of this machine, without judgement."""

import ctypes
from io import BytesIO
import os
from pathlib import Path
import resource
import shutil
import socket
import tempfile

_UNSYNCHRONISED = 0x40
"""Bit of the status of the kernel's clock: nobody keeps it right."""

_TIMEX_BYTES, _STATUS_OFFSET = 256, 40
"""Room for `struct timex` of Linux on 64 bits, and where its status is."""

_RECEIVE_MAX = Path('/proc/sys/net/core/rmem_max')

GL_LIBRARIES = {
    'EGL': ('libEGL.so.1',),
    'OSMesa': ('libOSMesa.so.8', 'libOSMesa.so.6'),
}


def real_time_refusal() -> str:
    """Return why this process may not have real-time priority, empty if it may."""
    policy, parameters = os.sched_getscheduler(0), os.sched_getparam(0)
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
        os.sched_setscheduler(0, policy, parameters)
    except OSError as error:
        return error.strerror or str(error)
    return ''


def lockable_bytes() -> int | None:
    """Return how much memory this process may lock; None for any amount."""
    soft, _ = resource.getrlimit(resource.RLIMIT_MEMLOCK)
    return None if soft == resource.RLIM_INFINITY or os.geteuid() == 0 else soft


def cpus() -> int:
    """Return on how many CPUs this process may run."""
    return len(os.sched_getaffinity(0))


def load() -> float:
    """Return how many processes wanted to run in the last minute, on average."""
    return os.getloadavg()[0]


def clock_is_kept() -> bool:
    """Tell whether the kernel knows of somebody who keeps its clock right."""
    timex = ctypes.create_string_buffer(_TIMEX_BYTES)
    if ctypes.CDLL(None).adjtimex(timex) < 0:
        return False
    status = int.from_bytes(timex.raw[_STATUS_OFFSET : _STATUS_OFFSET + 4], 'little')
    return not status & _UNSYNCHRONISED


def free_bytes(directory: Path) -> int:
    """Return how much may still be written below a directory."""
    return shutil.disk_usage(directory).free


def writable(directory: Path) -> bool:
    """Tell whether files can be made in a directory, which itself may be yet to be made."""
    place = next(p for p in (directory, *directory.absolute().parents) if p.exists())
    try:
        with tempfile.TemporaryFile(dir=place):
            return True
    except OSError:
        return False


def port_refusal(kind: socket.SocketKind, port: int) -> str:
    """Return why a port of this host cannot be had, empty if it can.

    Args:
        kind: SOCK_STREAM for TCP, SOCK_DGRAM for UDP.
        port: its number.

    """
    with socket.socket(socket.AF_INET, kind) as probe:
        if kind is socket.SOCK_STREAM:
            # As servers do: a connection that was just closed is in nobody's way.
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(('', port))
        except OSError as error:
            return error.strerror or str(error)
    return ''


def drawing_failure() -> str:
    """Return why no picture can be drawn, empty if one can."""
    try:
        from matplotlib.figure import Figure

        Figure(figsize=(0.1, 0.1)).savefig(BytesIO(), format='png')
    except Exception as error:  # whatever it is, there are no pictures
        return f'{type(error).__name__}: {error}'
    return ''


def gl_libraries() -> tuple[str, ...]:
    """Return what could render without a screen."""
    return tuple(name for name, files in GL_LIBRARIES.items() if any(map(_loads, files)))


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def receive_queue_bytes() -> int:
    """Return how long a receive queue may be."""
    return int(_RECEIVE_MAX.read_text())
