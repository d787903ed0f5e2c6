# SPDX-License-Identifier: Apache-2.0
"""The account of injected faults: what was done to the system, and how it stood it."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import groupby

COLUMNS = (
    'row', 'fault', 'injections', 'survived', 'worst deviation', 'worst speed', 'worst force',
    'worst reaction', 'bound',
)  # fmt: skip


@dataclass
class Injection:
    """One fault that was injected.

    Attributes:
        row: number of the row in the fault matrix.
        fault: what was done, in words.
        bound_ms: time within which the system must react [ms]; None where none is promised.
        survived: nothing that the test demands was missed.
        deviation_mm: farthest that the tip went where it should not have gone [mm].
        speed: fastest that the tip moved from the fault on [m/s].
        force: strongest that the tool pressed on something [N].
        reaction_ms: time from the fault to the reaction [ms].

    """

    row: int
    fault: str
    bound_ms: float | None = None
    survived: bool = False
    deviation_mm: float | None = None
    speed: float | None = None
    force: float | None = None
    reaction_ms: float | None = None


@dataclass
class FaultLedger:
    """All injections of a run of the tests.

    Attributes:
        repeats: how often every fault is to be injected.
        injections: what was injected, in order.

    """

    repeats: int
    injections: list[Injection] = field(default_factory=list)

    @contextmanager
    def injection(
        self, row: int, fault: str, bound_ms: float | None = None
    ) -> Iterator[Injection]:
        """Inject a fault in the body; it is survived if the body ends without an error.

        Measured figures are set as attributes of what this yields. A reaction that took
        longer than `bound_ms` is an error as well.
        """
        entry = Injection(row, fault, bound_ms)
        self.injections.append(entry)
        yield entry
        if bound_ms is not None and entry.reaction_ms is not None:
            late = f'{fault}: {entry.reaction_ms:g} > {bound_ms:g} ms'
            # Times are sums of ticks, and not exact.
            assert entry.reaction_ms <= bound_ms + 1e-6, late
        entry.survived = True

    def table(self) -> list[str]:
        """Return one line per fault, the last one for all, in Markdown."""
        def key(entry: Injection) -> tuple[int, str]:
            return entry.row, entry.fault

        lines = [_line(COLUMNS), _line(['---'] * len(COLUMNS))]
        for (row, fault), group in groupby(sorted(self.injections, key=key), key):
            entries = list(group)
            cells = (
                str(row), fault, str(len(entries)), str(sum(e.survived for e in entries)),
                _worst([e.deviation_mm for e in entries], '{:.1f} mm'),
                _worst([e.speed for e in entries], '{:.3f} m/s'),
                _worst([e.force for e in entries], '{:.0f} N'),
                _worst([e.reaction_ms for e in entries], '{:.1f} ms'),
                _worst([e.bound_ms for e in entries], '{:g} ms'),
            )  # fmt: skip
            lines.append(_line(cells))
        survived = sum(entry.survived for entry in self.injections)
        faults = len({key(entry) for entry in self.injections})
        return [*lines, '', f'{faults} faults, {survived} of {len(self.injections)} survived']


def _line(cells: Iterable[str]) -> str:
    return f'| {" | ".join(cells)} |'


def _worst(values: list[float | None], form: str) -> str:
    known = [value for value in values if value is not None]
    return form.format(max(known)) if known else ''
