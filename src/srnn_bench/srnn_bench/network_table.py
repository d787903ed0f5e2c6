# SPDX-License-Identifier: Apache-2.0
"""Table 1: the same network, run by each contender in turn."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from srnn_bench.contender import Contender, Entry, started
from srnn_bench.network_contenders import PLANNER, SAMPLER, NetworkSetting
from srnn_bench.quantiles import Quantiles, quantiles

NETWORK_COLUMNS = (
    'row', 'p50 / p95 [ms]', 'times the sampler', 'times whole planning',
    'whole call, p50 / p95 [ms]', 'runs', 'spikes per movement', 'build [s]', 'remark',
)  # fmt: skip


TURN = 5
"""Runs that count in a turn; the one before them finds what others have left in the caches."""

SLOW_ROUNDS = 4
"""Slow rows have a turn in every one of so many rounds, of a single run."""


@dataclass(eq=False)
class NetworkRow:
    """What was measured of a contender.

    Attributes:
        entry: who it is, and whether it failed.
        milliseconds: of each run, what it says itself.
        calls: of each run, all that the caller waits for [ms].
        spikes: of each run, per movement.

    """

    entry: Entry[NetworkSetting]
    milliseconds: list[float] = field(default_factory=list)
    calls: list[float] = field(default_factory=list)
    spikes: list[float] = field(default_factory=list)

    @property
    def time(self) -> Quantiles:
        """Quantiles of its runs [ms]."""
        return quantiles(self.milliseconds)

    def turn(self, setting: NetworkSetting, number: int) -> None:
        """Run in a round, if it is the turn of this row."""
        slow = self.entry.contender.slow
        if slow and number % SLOW_ROUNDS:
            return
        if not slow:
            self.entry.run(setting.seed)
        for n in range(1 if slow else TURN):
            self._run(setting, setting.seed + 1 + number * TURN + n)

    def _run(self, setting: NetworkSetting, seed: int) -> None:
        run = self.entry.run(seed)
        if run is None:
            return
        assert self.entry.runner is not None
        self.milliseconds.append(1e3 * run.seconds)
        self.calls.append(1e3 * self.entry.runner.seconds)
        self.spikes.append(float(run.spikes.sum()) / setting.planning.sampling.samples)


def measure_network(
    contenders: Sequence[Contender[NetworkSetting]],
    setting: NetworkSetting,
    repeats: int,
    say: Callable[[str], None],
) -> list[NetworkRow]:
    """Run all contenders in turn, `repeats` times, `TURN` runs at a time; slow ones less often.

    Args:
        contenders: who takes part.
        setting: the network.
        repeats: number of rounds.
        say: told what goes on.

    """
    say(f'network: building {", ".join(c.name for c in contenders)}')
    with started(contenders, setting, (setting.seed,)) as entries:
        rows = [NetworkRow(entry) for entry in entries]
        for number in range(repeats):
            say(f'network: round {number + 1} of {repeats}')
            for row in rows:
                row.turn(setting, number)
    return rows


def ratio(row: NetworkRow, rows: Sequence[NetworkRow], name: str) -> float | None:
    """Return how many times as long a row takes as that of a name, None without one of them."""
    named = [r for r in rows if r.entry.contender.name == name and not r.entry.failure]
    if row.entry.failure or not named:
        return None
    return row.time.p50 / named[0].time.p50


def network_cells(rows: Sequence[NetworkRow]) -> list[list[str]]:
    """Return the cells of the table, row by row."""
    cells = []
    for row in rows:
        contender = row.entry.contender
        if row.entry.failure:
            empty = [''] * (len(NETWORK_COLUMNS) - 3)
            cells.append([contender.title, row.entry.failure, *empty, contender.remark])
            continue
        times = [ratio(row, rows, name) for name in (SAMPLER, PLANNER)]
        cells.append([
            contender.title, row.time.text(2), *('' if t is None else f'{t:.1f}' for t in times),
            quantiles(row.calls).text(2), str(len(row.calls)), f'{np.mean(row.spikes):.1f}',
            f'{row.entry.build:.1f}', contender.remark,
        ])  # fmt: skip
    return cells


def network_figures(rows: Sequence[NetworkRow]) -> list[dict[str, object]]:
    """Return all figures as plain data for JSON."""
    return [
        {
            'name': row.entry.contender.name,
            'failure': row.entry.failure,
            'build_s': row.entry.build,
            'ratio': ratio(row, rows, SAMPLER),
            'ratio_planning': ratio(row, rows, PLANNER),
            'milliseconds': row.milliseconds,
            'call_ms': row.calls,
            'spikes_per_movement': row.spikes,
        }
        for row in rows
    ]
