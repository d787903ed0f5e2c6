# SPDX-License-Identifier: Apache-2.0
"""Table 2: the same tour around a known obstacle, by each contender in turn."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from srnn_bench.contender import Contender, Entry, started
from srnn_bench.navigation_contenders import NavigationSetting
from srnn_bench.navigation_task import NavigationTask
from srnn_bench.path_quality import Quality, quality
from srnn_bench.quantiles import quantiles

NAVIGATION_COLUMNS = (
    'row', 'one plan, p50 / p95 [ms]', 'plans a leg', 'one leg, p50 / p95 [ms]',
    'length over shortest, p50 / p95', 'the same, blocked leg',
    'least room on a tour, p50, least [mm]', 'legs done', 'remark',
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class LegFigures:
    """What was measured on a leg.

    Attributes:
        leg: its number.
        seed: of the tour.
        plans_ms: time of each planning.
        quality: how good the path was.

    """

    leg: int
    seed: int
    plans_ms: list[float]
    quality: Quality


@dataclass(eq=False)
class NavigationRow:
    """What was measured of a contender.

    Attributes:
        entry: who it is, and whether it failed.
        legs: all legs of all tours.

    """

    entry: Entry[NavigationSetting]
    legs: list[LegFigures] = field(default_factory=list)

    def rooms(self) -> list[float]:
        """Return the least room on each tour [mm]."""
        least: dict[int, float] = {}
        for leg in self.legs:
            least[leg.seed] = min(least.get(leg.seed, np.inf), 1e3 * leg.quality.room)
        return list(least.values())

    def ratios(self, only: int | None = None) -> list[float]:
        """Return length over shortest of the legs that were done, or of one of them."""
        return [
            leg.quality.ratio for leg in self.legs
            if leg.quality.reached and only in (None, leg.leg)
        ]  # fmt: skip


def measure_navigation(
    contenders: Sequence[Contender[NavigationSetting]],
    setting: NavigationSetting,
    seeds: Sequence[int],
    say: Callable[[str], None],
) -> list[NavigationRow]:
    """Go a tour for each seed; on each leg all contenders take their turns.

    Args:
        contenders: who takes part.
        setting: the task.
        seeds: of the tours.
        say: told what goes on.

    """
    say(f'known obstacle: starting {", ".join(c.name for c in contenders)}')
    task = setting.task
    with started(contenders, setting, (0, seeds[0])) as entries:
        rows = [NavigationRow(entry) for entry in entries]
        for number, seed in enumerate(seeds):
            say(f'known obstacle: tour {number + 1} of {len(seeds)}')
            for leg, way in enumerate(task.legs):
                for row in rows:
                    attempt = row.entry.run(leg, seed)
                    if attempt is not None:
                        times = [1e3 * seconds for seconds in attempt.seconds]
                        judged = quality(task, way, attempt.path)
                        row.legs.append(LegFigures(leg, seed, times, judged))
    return rows


def navigation_cells(rows: Sequence[NavigationRow], task: NavigationTask) -> list[list[str]]:
    """Return the cells of the table, row by row."""
    return [_cells(row, task) for row in rows]


def _cells(row: NavigationRow, task: NavigationTask) -> list[str]:
    contender = row.entry.contender
    if row.entry.failure:
        blanks = len(NAVIGATION_COLUMNS) - 3
        return [contender.title, row.entry.failure, *[''] * blanks, contender.remark]
    rooms = row.rooms()
    return [
        contender.title,
        quantiles([ms for leg in row.legs for ms in leg.plans_ms]).text(2),
        f'{np.mean([len(leg.plans_ms) for leg in row.legs]):.1f}',
        quantiles([sum(leg.plans_ms) for leg in row.legs]).text(1),
        _ratio_text(row.ratios()),
        _ratio_text(row.ratios(task.blocked)),
        f'{np.median(rooms):.0f}, {min(rooms):.0f}',
        f'{sum(leg.quality.reached for leg in row.legs)} of {len(row.legs)}',
        contender.remark,
    ]


def _ratio_text(ratios: Sequence[float]) -> str:
    return quantiles(ratios).text(2) if ratios else '-'


def navigation_figures(rows: Sequence[NavigationRow]) -> list[dict[str, object]]:
    """Return all figures as plain data for JSON."""
    return [
        {
            'name': row.entry.contender.name,
            'failure': row.entry.failure,
            'legs': [
                {
                    'leg': leg.leg,
                    'seed': leg.seed,
                    'plans_ms': leg.plans_ms,
                    'reached': leg.quality.reached,
                    'length_over_shortest': leg.quality.ratio,
                    'least_room_m': leg.quality.room if np.isfinite(leg.quality.room) else None,
                }
                for leg in row.legs
            ],
        }
        for row in rows
    ]
