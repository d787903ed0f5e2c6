# SPDX-License-Identifier: Apache-2.0
"""What `bench/scale.py` has found, in Markdown, and which goals are missed."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from scale_fit import power_law
from scale_run import Measured, Times
from timing import machine

FINEST_PLANE, PAPER, FINEST_SPACE = (2, 101), (2, 15), (3, 31)
RATIO_MAX = 25.0
"""Goal for the time of a plan with 101 x 101 neurons over that with 15 x 15."""

SPACE_MS_MAX = 60.0
"""Goal for a plan with 31 x 31 x 31 neurons [ms]."""


@dataclass(frozen=True)
class Found:
    """All cases.

    Attributes:
        sizes: by number of dimensions, each with more neurons than the one before.
        samples: the paper's size with more and more samples.
        replays: the same with more and more replays.
        limit_gib: most memory that a process may have.

    """

    sizes: dict[int, list[Measured]]
    samples: list[Measured]
    replays: list[Measured]
    limit_gib: float


@dataclass(frozen=True)
class Goal:
    """A figure that must not exceed a limit; None: not measured."""

    name: str
    figure: float | None
    limit: float
    unit: str

    @property
    def missed(self) -> bool:
        """Tell whether it is; what was not measured is."""
        return self.figure is None or self.figure > self.limit

    def line(self) -> str:
        """Return it in words."""
        figure = 'not measured' if self.figure is None else f'{self.figure:.1f}{self.unit}'
        verdict = 'missed' if self.missed else 'kept'
        return f'- {self.name}: {figure}, goal at most {self.limit:g}{self.unit}: {verdict}.'


def goals(found: Found) -> list[Goal]:
    """Return all goals; a plan counts with the target that takes longer."""
    worst = {
        (m.case.dimensions, m.case.side): max(m.times.plan_ms, m.times.across_ms)
        for row in found.sizes.values() for m in row if m.times
    }  # fmt: skip
    finest, paper = worst.get(FINEST_PLANE), worst.get(PAPER)
    return [
        Goal(
            'A plan with 101 × 101 neurons over one with 15 × 15',
            finest / paper if finest and paper else None, RATIO_MAX, '',
        ),
        Goal('A plan with 31 × 31 × 31 neurons', worst.get(FINEST_SPACE), SPACE_MS_MAX, ' ms'),
    ]  # fmt: skip


def of_times(row: Sequence[Measured]) -> list[tuple[Measured, Times]]:
    """Return what was timed."""
    return [(m, m.times) for m in row if m.times]


def table(found: Found) -> str:
    """Return the tables, the exponents and the goals."""
    return '\n'.join([
        f'{machine()}.', '',
        '| grid | neurons | plan | target far | update | taken over | spikes | valid | pace | '
        'memory | message |',
        f'|{"---|" * 11}',
        *(_size(m, found.limit_gib) for row in found.sizes.values() for m in row), '',
        '| samples | plan | spikes |', '|---|---|---|',
        *(f'| {m.case.samples} | {t.plan_ms:.2f} ms | {t.spikes:.0f} |'
          for m, t in of_times(found.samples)), '',
        '| replays | update |', '|---|---|',
        *(f'| {m.case.replays} | {t.update_ms:.2f} ms |' for m, t in of_times(found.replays)), '',
        *_laws(found),
        *(goal.line() for goal in goals(found)),
    ])  # fmt: skip


def _size(m: Measured, limit_gib: float) -> str:
    grid = ' × '.join([str(m.case.side)] * m.case.dimensions)
    if m.times is None or m.memory is None:
        return f'| {grid} | {m.case.neurons} | more than {limit_gib:g} GiB |{" |" * 8}'
    t = m.times
    return (
        f'| {grid} | {m.case.neurons} | {t.plan_ms:.2f} ms | {t.across_ms:.2f} ms | '
        f'{t.update_ms:.2f} ms | {t.take_ms:.2f} ms | {t.spikes:.0f} | '
        f'{t.valid:.0%}, {t.valid_across:.0%} | {t.pace:.1f}, {t.pace_across:.1f} | '
        f'{1e-6 * m.memory:.1f} MB | {1e-3 * t.wire_bytes:.1f} kB |'
    )


def _laws(found: Found) -> Iterator[str]:
    for dimensions, row in found.sizes.items():
        timed = of_times(row)
        if len(timed) < 2:
            continue
        neurons = [m.case.neurons for m, _ in timed]
        powers: dict[str, list[float]] = {
            'plan': [t.plan_ms for _, t in timed],
            'plan with the target far': [t.across_ms for _, t in timed],
            'update': [t.update_ms for _, t in timed],
            'taking over': [t.take_ms for _, t in timed],
            'memory': [m.memory or 1 for m, _ in timed],
            'message': [t.wire_bytes for _, t in timed],
        }
        words = ', '.join(
            f'{name} {power_law(neurons, y).exponent:.2f}' for name, y in powers.items()
        )
        yield f'- Exponents of the number of neurons, {dimensions} dimensions: {words}.'
    timed = of_times(found.samples)
    work = [t.spikes * t.fan_out for _, t in timed]
    law = power_law(work, [t.plan_ms for _, t in timed])
    yield f'- Exponent of spikes × fan-out, for more samples: plan {law.exponent:.2f}.'
    timed = of_times(found.replays)
    law = power_law([m.case.replays for m, _ in timed], [t.update_ms for _, t in timed])
    yield f'- Exponent of the number of replays: update {law.exponent:.2f}.'
    each = '; '.join(
        f'{" × ".join([str(m.case.side)] * m.case.dimensions)}: '
        f'{1e6 * t.plan_ms / (t.spikes * t.fan_out):.2f} ns, fan-out {t.fan_out}'
        for row in found.sizes.values() if row for m, t in of_times(row[-1:])
    )  # fmt: skip
    if each:
        yield f'- Time of a plan for each spike and synapse, largest sizes: {each}.'
