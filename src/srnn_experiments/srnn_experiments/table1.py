# SPDX-License-Identifier: Apache-2.0
"""Table 1 of the paper, with the rows that it lacks and two yardsticks."""

from collections.abc import Mapping, Sequence
import csv
from dataclasses import asdict, replace
import io
from typing import Any

from srnn_experiments.estimates import mean_text, share_estimate, share_text
from srnn_experiments.intervals import describe, paired_interval
from srnn_experiments.paper import TABLE_1
from srnn_experiments.setting import Setting

TRIALS = 10
SEGMENTS = 300

ROWS: dict[str, tuple[str, float | None]] = {
    'none': ('none', None),
    'constant 0.001': ('constant', 0.001),
    'constant 0.01': ('constant', 0.01),
    'constant 0.1': ('constant', 0.1),
    'untriggered 0.001': ('untriggered', 0.001),
    'global': ('global', None),
    'local': ('local', None),
}
"""Signal and rate of every row with a learning signal."""

YARDSTICKS = {'oracle': 'oracle', 'grid': 'grid'}
"""Rows by another agent: told of every obstacle, and A* that marks contacts."""

LEARNED_LAPS = 3

COLUMNS = {
    'updates_triggered': 'updates',
    'contacts': 'contacts',
    'contacts_last_100': 'contacts in the last 100',
    'reached_blocked': 'blocked reached',
    'laps': 'laps',
    'execution_s': 'execution [s]',
    'planning_ms': 'planning [ms]',
    'update_ms': 'update [ms]',
    'invalid_plans': 'invalid plans',
}
"""Figures of a row and their headings."""

_OF_PAPER = {
    'updates_triggered': 'updates',
    'update_ms': 'update_ms',
    'planning_ms': 'planning_ms',
    'execution_s': 'execution_s',
    'reached_blocked': 'reached',
}


def settings(base: Setting) -> dict[str, Setting]:
    """Return the settings of all rows by name."""
    rows = {name: base.with_signal(signal, rate) for name, (signal, rate) in ROWS.items()}
    ignorant = base.with_signal('none')
    for name, agent in YARDSTICKS.items():
        rows[name] = replace(ignorant, agent=agent)
    return rows


def learned(trial: Mapping[str, Any]) -> bool:
    """Tell whether a trial learned: at least three laps, no contact in the last 100."""
    return bool(trial['laps'] >= LEARNED_LAPS and trial['contacts_last_100'] == 0)


def differences(
    trials: Mapping[str, Sequence[Mapping[str, Any]]], reference: str, key: str
) -> dict[str, dict[str, float]]:
    """Return by how much a row is ahead of the others, paired by seed, with intervals."""
    ahead = [float(trial[key]) for trial in trials[reference]]
    result = {}
    for name, others in trials.items():
        if name != reference:
            values = [float(trial[key]) for trial in others]
            low, high = paired_interval(ahead, values)
            mean = sum(a - b for a, b in zip(ahead, values, strict=True)) / len(values)
            result[name] = {'mean': mean, 'low': low, 'high': high}
    return result


def efficiencies(trials: Mapping[str, Sequence[Mapping[str, Any]]]) -> dict[str, float | None]:
    """Return the laps of every row over those of the oracle; None if that makes no lap."""
    laps = {name: sum(trial['laps'] for trial in done) for name, done in trials.items()}
    best = laps['oracle']
    return {name: count / best if best else None for name, count in laps.items()}


def row(trials: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Return the statistics of one row.

    Every figure has mean, standard deviation over trials and the 95 % interval of the
    mean; `learned` is a share with its interval.
    """
    result: dict[str, Any] = {'trials': len(trials)}
    for name in COLUMNS:
        values = [value for t in trials if (value := figure(t, name)) is not None]
        result[name] = describe(values) if values else None
    result['learned'] = share_estimate(sum(map(learned, trials)), len(trials))
    return result


def figure(trial: Mapping[str, Any], name: str) -> float | None:
    """Return one figure of a trial as a number."""
    if name == 'reached_blocked':
        return float(len(trial['segments_to_blocked']))
    if name == 'execution_s':
        return _optional(trial['planned_execution_s']['mean'])
    value = trial[name]
    return _optional(value['mean'] if isinstance(value, Mapping) else value)


def as_csv(table: Mapping[str, Mapping[str, Any]]) -> str:
    """Return a table, one line per row, with mean, sd and interval of every figure."""
    parts = ('mean', 'sd', 'low', 'high')
    text = io.StringIO()
    writer = csv.writer(text, lineterminator='\n')
    figures = [f'{column}_{part}' for column in COLUMNS for part in parts]
    writer.writerow(['row', 'trials', 'learned', *figures, 'paper_reached'])
    for name, values in table.items():
        numbers = [
            '' if values[c] is None else f'{values[c][p]:.6g}' for c in COLUMNS for p in parts
        ]
        paper = f'{TABLE_1[name].reached[0]}' if name in TABLE_1 else ''
        learned_share = f'{values["learned"]["share"]:.3f}'
        writer.writerow([name, values['trials'], learned_share, *numbers, paper])
    return text.getvalue()


def as_markdown(table: Mapping[str, Mapping[str, Any]]) -> str:
    """Return a table: mean ± sd [95 % interval of the mean], in brackets the paper's."""
    lines = [
        '| row | learned | ' + ' | '.join(COLUMNS.values()) + ' |',
        '|---' * (2 + len(COLUMNS)) + '|',
    ]
    for name, values in table.items():
        cells = [share_text(values['learned'])]
        cells += [_cell(name, column, values[column]) for column in COLUMNS]
        lines.append(f'| {name} | ' + ' | '.join(cells) + ' |')
    return '\n'.join(lines) + '\n'


def _cell(name: str, column: str, values: Mapping[str, float] | None) -> str:
    if values is None:
        return '–'
    text = mean_text(values)
    if name in TABLE_1 and column in _OF_PAPER:
        mean, sd = asdict(TABLE_1[name])[_OF_PAPER[column]]
        text += f' (paper {mean:g} ± {sd:g})'
    return text


def _optional(value: Any) -> float | None:
    return None if value is None else float(value)
