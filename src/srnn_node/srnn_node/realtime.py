# SPDX-License-Identifier: Apache-2.0
"""Real-time scheduling and locked memory, where the process has the right to them."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
import ctypes
from dataclasses import dataclass
import os

from srnn_node.errors import SchedulingError

VARIABLE = 'SRNN_REALTIME_PRIORITY'
"""Environment variable that overrides the priority a node asks for; 0 asks for none."""

_HIGHEST = 99
_LOCK_CURRENT_AND_FUTURE = 1 | 2


@dataclass(frozen=True)
class Scheduling:
    """How the process is scheduled.

    Attributes:
        granted: False when less was given than asked for.
        words: what was asked for and given, for a person.

    """

    granted: bool
    words: str


def request_realtime(default: int = 0, environ: Mapping[str, str] = os.environ) -> Scheduling:
    """Ask for SCHED_FIFO and locked memory.

    Call it before rclpy.init, so that the threads of the middleware inherit it.

    Args:
        default: priority to ask for, 1 to 99; 0 for none.
        environ: where `VARIABLE` is looked up.

    Raises:
        SchedulingError: the variable holds no valid priority.

    """
    priority = _priority(environ.get(VARIABLE, ''), default)
    if priority == 0:
        return Scheduling(True, 'normal scheduling')
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
    except OSError as error:
        return Scheduling(False, f'normal scheduling, no SCHED_FIFO {priority}: {error.strerror}')
    refused = _lock_memory()
    if refused:
        return Scheduling(False, f'SCHED_FIFO {priority}, memory not locked: {refused}')
    return Scheduling(True, f'SCHED_FIFO {priority}, memory locked')


def prefer_thread(priority: int, environ: Mapping[str, str] = os.environ) -> bool:
    """Give this thread a real-time priority, or take it back with 0.

    For nodes that work hard for a moment and must not do so while they start: with a
    real-time priority from the beginning, loading would stand in the way of the arm.

    Args:
        priority: SCHED_FIFO priority, 1 to 99; 0 for normal scheduling.
        environ: where `VARIABLE` = 0 switches priorities off.

    Returns:
        Whether it was granted.

    """
    if environ.get(VARIABLE) == '0':
        return False
    policy = os.SCHED_FIFO if priority else os.SCHED_OTHER
    try:
        os.sched_setscheduler(0, policy, os.sched_param(priority))
    except OSError:
        return False
    return True


@contextmanager
def unhurried() -> Iterator[None]:
    """Do without the real-time priority of this thread for a while.

    Compiling takes seconds, and would keep every arm waiting that is already controlled on
    this machine. Threads that are there already keep their priority.
    """
    policy, parameters = os.sched_getscheduler(0), os.sched_getparam(0)
    if policy != os.SCHED_FIFO:
        yield
        return
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    try:
        yield
    finally:
        os.sched_setscheduler(0, policy, parameters)


def _priority(text: str, default: int) -> int:
    if not text:
        return default
    if not (text.isdecimal() and int(text) <= _HIGHEST):
        raise SchedulingError(
            f'{VARIABLE} = {text!r}: must be 1 to {_HIGHEST}, or 0 for normal scheduling'
        )
    return int(text)


def _lock_memory() -> str:
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.mlockall(_LOCK_CURRENT_AND_FUTURE) == 0:
        return ''
    return os.strerror(ctypes.get_errno())
