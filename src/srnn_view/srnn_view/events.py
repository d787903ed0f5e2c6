# SPDX-License-Identifier: Apache-2.0
"""What happens in a run besides that segments are executed."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum

from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.result import ResultCode, SegmentResult


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
        said_again: its source says it again and again while it is so.

    """

    time: float
    source: str
    grave: Grave
    text: str
    said_again: bool = False


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
        yield Event(time, source, grave, status.message if bad else '', said_again=True)


class EventLog:
    """Events in order, each once that is said again and again."""

    def __init__(self, longest: int | None = None) -> None:
        """Keep the last `longest` events, all if None."""
        self._longest = longest
        self._last: dict[str, str] = {}
        self.events: list[Event] = []

    def add(self, event: Event) -> bool:
        """Take in an event; return whether it says something new."""
        if event.said_again:
            repeated = self._last.get(event.source, '') == event.text
            self._last[event.source] = event.text
            if repeated or not event.text:
                return False
        self.events.append(event)
        if self._longest is not None:
            del self.events[: -self._longest]
        return True
