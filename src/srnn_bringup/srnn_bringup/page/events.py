# SPDX-License-Identifier: Apache-2.0
"""What happened in a run besides that segments were executed."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum

from rcl_interfaces.msg import Log
from rclpy.serialization import deserialize_message

from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.result import ResultCode, SegmentResult

WARNING = 30
"""Severity from which on a line of the log is an event."""


class Grave(Enum):
    """How bad an event is."""

    NOTE = 'note'
    WARN = 'warn'
    ERROR = 'error'


@dataclass(frozen=True)
class Event:
    """One thing that happened.

    Attributes:
        time: since the beginning of the run [s].
        source: which node tells, and where.
        grave: how bad it is.
        text: what happened; empty for: what was, is no longer.

    """

    time: float
    source: str
    grave: Grave
    text: str


def of_result(time: float, result: SegmentResult) -> Iterator[Event]:
    """Yield the event of a segment that did not end as planned."""
    if result.code is ResultCode.BLOCKED:
        force = result.values.get('force_n')
        strength = '' if force is None else f', {force:.0f} N'
        yield Event(time, 'tracker', Grave.WARN, f'touch: {result.reason}{strength}')
    elif result.code is not ResultCode.DONE:
        grave = Grave.ERROR if result.code is ResultCode.FAULT else Grave.NOTE
        yield Event(time, 'tracker', grave, f'{result.code.value}: {result.reason}')


def of_health(time: float, health: Mapping[str, Health]) -> Iterator[Event]:
    """Yield what nodes are worried by."""
    for name, status in health.items():
        bad = status.level in (HealthLevel.WARN, HealthLevel.ERROR)
        grave = Grave.ERROR if status.level is HealthLevel.ERROR else Grave.WARN
        source = f'{name.rpartition("/")[2]} (health)'
        yield Event(time, source, grave, status.message if bad else '')


def of_log(time: float, data: bytes) -> Iterator[Event]:
    """Yield a line of the log that warns."""
    line = deserialize_message(data, Log)
    if line.level >= WARNING:
        grave = Grave.ERROR if line.level > WARNING else Grave.WARN
        yield Event(time, f'{line.name} (log)', grave, line.msg)
