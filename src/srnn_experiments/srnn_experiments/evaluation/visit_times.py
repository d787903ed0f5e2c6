# SPDX-License-Identifier: Apache-2.0
"""How many segments a visit of the blocked way point takes, visit by visit."""

from collections.abc import Sequence
from math import isfinite
from typing import Any

import numpy as np

from srnn_experiments.evaluation.trials import SIGNALS, Evaluation, Trial
from srnn_experiments.intervals import describe, trial_weights
from srnn_experiments.paper import TABLE_1
from srnn_experiments.visits import Visits, spent_per_visit, visit_lengths


def numbers(evaluation: Evaluation) -> dict[str, Any]:
    """Return every visit, when it was completed, and what was spent for it."""
    blocked = evaluation.base.scene.task.blocked
    return {
        **evaluation.known('local'),
        'waypoint': blocked + 1,
        'signals': {name: _signal(name, evaluation.trials[name], blocked) for name in SIGNALS},
    }


def headline(found: dict[str, Any]) -> str:
    """Return the finding in one line."""
    parts = [
        f'{name} {rounded(signal["spent_per_visit"])}' for name, signal in found['signals'].items()
    ]
    return f'Segments per completed visit of the blocked way point: {", ".join(parts)}'


def caption(found: dict[str, Any]) -> str:
    """Return what the figure shows, in words."""
    return (
        f'Visits of the blocked way point {found["waypoint"]}, {len(found["seeds"])} trials of '
        f'{found["segments"]} segments. Left: segments that every visit needed; open triangles '
        'are visits that were never completed, at the segments they had taken when the trial '
        'ended; lines: segments spent for each completed visit, over the trials that begin '
        'that visit, while at least half of all do. Right: visits completed so far, every trial '
        'and their mean, and mean ± sd of the paper. Segments spent are all on the way to the '
        'way point, those of visits that were cut off as well. Bars and brackets: 95 % bootstrap '
        'over whole trials; a bar without an upper end is endless.'
    )


def key_numbers(found: dict[str, Any]) -> list[str]:
    """Return a line for each setting."""
    lines = []
    for name, signal in found['signals'].items():
        reached = signal['completed_per_trial']
        paper = ' (paper {:g} ± {:g})'.format(*signal['paper']) if signal['paper'] else ''
        lines.append(
            f'{name}: {rounded(signal["spent_per_visit"])} [{rounded(signal["low"])}, '
            f'{rounded(signal["high"])}] segments spent for each completed visit, '
            f'{reached["mean"]:.1f} ± {reached["sd"]:.1f} [{reached["low"]:.1f}, '
            f'{reached["high"]:.1f}] visits per trial{paper}, {signal["cut_off"]} of '
            f'{signal["begun"]} visits cut off by the end of their trial, the longest after '
            f'{signal["longest_cut_off"]} segments'
        )
    return lines


def rounded(count: float | None) -> str:
    """Return a number of segments as text; None is endless."""
    return '∞' if count is None else f'{count:.1f}'


def _signal(name: str, trials: Sequence[Trial], blocked: int) -> dict[str, Any]:
    traces = [trial['trace'] for trial in trials]
    visits = [visit_lengths(t['active'], t['reached'], blocked) for t in traces]
    completed = [float(len(v.completed)) for v in visits]
    cut_off = [v.open for v in visits if v.open]
    most = max(len(v.completed) + (v.open > 0) for v in visits)
    return {
        'completed_at': [_completed_at(t['active'], t['reached'], blocked) for t in traces],
        'by_visit': [_nth(visits, n) for n in range(most)],
        **_spent(visits),
        'completed_per_trial': describe(completed),
        'begun': int(sum(completed)) + len(cut_off),
        'cut_off': len(cut_off),
        'longest_cut_off': max(cut_off, default=0),
        'paper': list(TABLE_1[name].reached) if name in TABLE_1 else None,
    }


def _completed_at(active: Sequence[int], reached: Sequence[bool], index: int) -> list[int]:
    """Return the segments of a trial, from 1, in which a visit was completed."""
    pairs = enumerate(zip(active, reached, strict=True), start=1)
    return [number for number, (target, arrived) in pairs if arrived and target == index]


def _nth(visits: Sequence[Visits], n: int) -> dict[str, Any]:
    """Return what is known of the visit with index n over the trials that begin it."""
    begun = [
        Visits(v.completed[n : n + 1], v.open if n == len(v.completed) else 0)
        for v in visits
        if n < len(v.completed) + (v.open > 0)
    ]
    return {
        'visit': n + 1,
        'completed': sorted(count for v in begun for count in v.completed),
        'cut_off_after': sorted(v.open for v in begun if v.open),
        **_spent(begun),
    }


def _spent(visits: Sequence[Visits]) -> dict[str, float | None]:
    """Return segments spent for each completed visit with their interval; None is endless."""
    spent = np.array([float(sum(v.completed) + v.open) for v in visits])
    completed = np.array([float(len(v.completed)) for v in visits])
    weights = trial_weights(len(visits))
    resampled = spent_per_visit(weights @ spent, weights @ completed)
    low, high = np.percentile(resampled, [2.5, 97.5], method='inverted_cdf')
    mean = spent_per_visit(spent.sum(), completed.sum())
    found = {'spent_per_visit': mean, 'low': low, 'high': high}
    return {name: float(value) if isfinite(value) else None for name, value in found.items()}
