# SPDX-License-Identifier: Apache-2.0
"""Table 1: the same network, run by each contender in turn."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from srnn_bench.contender import Contender, Entry, started
from srnn_bench.network_contenders import SAMPLER, NetworkSetting
from srnn_bench.quantiles import Quantiles, quantiles

NETWORK_COLUMNS = (
    'row', 'p50 / p95 [ms]', 'times the sampler', 'spikes per movement', 'build [s]', 'remark',
)  # fmt: skip


TURN = 5
"""Runs that count in a turn; the one before them finds what others have left in the caches."""


@dataclass(eq=False)
class NetworkRow:
    """What was measured of a contender.

    Attributes:
        entry: who it is, and whether it failed.
        milliseconds: of each run.
        spikes: of each run, per movement.

    """

    entry: Entry[NetworkSetting]
    milliseconds: list[float] = field(default_factory=list)
    spikes: list[float] = field(default_factory=list)

    @property
    def time(self) -> Quantiles:
        """Quantiles of its runs [ms]."""
        return quantiles(self.milliseconds)


def measure_network(
    contenders: Sequence[Contender[NetworkSetting]],
    setting: NetworkSetting,
    repeats: int,
    say: Callable[[str], None],
) -> list[NetworkRow]:
    """Run all contenders in turn, `repeats` times, `TURN` runs at a time.

    Args:
        contenders: who takes part.
        setting: the network.
        repeats: number of rounds.
        say: told what goes on.

    """
    say(f'network: building {", ".join(c.name for c in contenders)}')
    samples = setting.planning.sampling.samples
    with started(contenders, setting, (setting.seed,)) as entries:
        rows = [NetworkRow(entry) for entry in entries]
        for number in range(repeats):
            say(f'network: round {number + 1} of {repeats}')
            seed = setting.seed + 1 + number * TURN
            for row in rows:
                row.entry.run(setting.seed)
                for run in (row.entry.run(seed + n) for n in range(TURN)):
                    if run is not None:
                        row.milliseconds.append(1e3 * run.seconds)
                        row.spikes.append(float(run.spikes.sum()) / samples)
    return rows


def ratio(row: NetworkRow, rows: Sequence[NetworkRow]) -> float | None:
    """Return how many times as long a row takes as the sampler, None without one of them."""
    sampler = [r for r in rows if r.entry.contender.name == SAMPLER and not r.entry.failure]
    if row.entry.failure or not sampler:
        return None
    return row.time.p50 / sampler[0].time.p50


def network_cells(rows: Sequence[NetworkRow]) -> list[list[str]]:
    """Return the cells of the table, row by row."""
    cells = []
    for row in rows:
        contender = row.entry.contender
        if row.entry.failure:
            cells.append([contender.title, row.entry.failure, '', '', '', contender.remark])
            continue
        times = ratio(row, rows)
        cells.append([
            contender.title, row.time.text(2), '' if times is None else f'{times:.1f}',
            f'{np.mean(row.spikes):.1f}', f'{row.entry.build:.1f}', contender.remark,
        ])  # fmt: skip
    return cells


def network_figures(rows: Sequence[NetworkRow]) -> list[dict[str, object]]:
    """Return all figures as plain data for JSON."""
    return [
        {
            'name': row.entry.contender.name,
            'failure': row.entry.failure,
            'build_s': row.entry.build,
            'ratio': ratio(row, rows),
            'milliseconds': row.milliseconds,
            'spikes_per_movement': row.spikes,
        }
        for row in rows
    ]
