# SPDX-License-Identifier: Apache-2.0
"""How many segments a visit of the blocked way point takes, visit by visit."""

from collections.abc import Sequence
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from srnn_experiments.evaluation.trials import SIGNALS, Evaluation, Trial
from srnn_experiments.intervals import describe, trial_weights
from srnn_experiments.paper import TABLE_1
from srnn_experiments.visits import Visits, median_length, unfinished, visit_lengths


def numbers(evaluation: Evaluation) -> dict[str, Any]:
    """Return every visit, the median by number of the visit, and the share unfinished."""
    blocked = evaluation.base.scene.task.blocked
    return {
        **evaluation.known('local'),
        'waypoint': blocked + 1,
        'signals': {
            name: _signal(name, evaluation.trials[name], blocked, evaluation.base.segments)
            for name in SIGNALS
        },
    }


def headline(found: dict[str, Any]) -> str:
    """Return the finding in one line."""
    parts = [f'{name} {segments(signal["median"])}' for name, signal in found['signals'].items()]
    return f'Median segments per visit of the blocked way point: {", ".join(parts)}'


def caption(found: dict[str, Any]) -> str:
    """Return what the figure shows, in words."""
    return (
        f'Segments for each visit of the blocked way point {found["waypoint"]}, '
        f'{len(found["seeds"])} trials of {found["segments"]} segments. Left: every visit; open '
        'triangles are visits that were never completed, at the segments they had taken when '
        'the trial ended; lines are medians over trials that allow for them (Kaplan-Meier), '
        'drawn while at least half of all trials begin that visit. Right: share of visits still '
        'unfinished after so many segments. Brackets, bars and bands: 95 % bootstrap over whole '
        'trials.'
    )


def key_numbers(found: dict[str, Any]) -> list[str]:
    """Return a line for each setting."""
    lines = []
    for name, signal in found['signals'].items():
        reached = signal['completed_per_trial']
        paper = ' (paper {:g} ± {:g})'.format(*signal['paper']) if signal['paper'] else ''
        lines.append(
            f'{name}: median {segments(signal["median"])} [{segments(signal["low"])}, '
            f'{segments(signal["high"])}] segments per visit, {reached["mean"]:.1f} ± '
            f'{reached["sd"]:.1f} [{reached["low"]:.1f}, {reached["high"]:.1f}] visits per trial'
            f'{paper}, {signal["cut_off"]} of {signal["begun"]} visits cut off by the end of '
            'their trial'
        )
    return lines


def segments(count: float | None) -> str:
    """Return a number of segments as text; None is more than was ever seen."""
    return 'not reached' if count is None else f'{count:g}'


def _signal(name: str, trials: Sequence[Trial], blocked: int, length: int) -> dict[str, Any]:
    visits = [visit_lengths(t['trace']['active'], t['trace']['reached'], blocked) for t in trials]
    ended, cut_off = _counts(visits, length)
    weights = trial_weights(len(visits))
    share = unfinished(ended.sum(axis=0), cut_off.sum(axis=0))
    resampled = unfinished(weights @ ended, weights @ cut_off)
    low, high = np.percentile(resampled, [2.5, 97.5], axis=0)
    most = max(len(v.completed) + (v.open > 0) for v in visits)
    return {
        'visits': [{'completed': v.completed, 'cut_off_after': v.open or None} for v in visits],
        'by_visit': [_nth(visits, n, length) for n in range(most)],
        'unfinished': {'share': share.tolist(), 'low': low.tolist(), 'high': high.tolist()},
        **_median(share, resampled),
        'completed_per_trial': describe([float(len(v.completed)) for v in visits]),
        'begun': int(ended.sum() + cut_off.sum()),
        'cut_off': int(cut_off.sum()),
        'paper': list(TABLE_1[name].reached) if name in TABLE_1 else None,
    }


def _nth(visits: Sequence[Visits], n: int, length: int) -> dict[str, Any]:
    """Return what is known of the visit with index n over the trials that began it."""
    begun = [
        Visits(v.completed[n : n + 1], v.open if n == len(v.completed) else 0)
        for v in visits
        if n < len(v.completed) + (v.open > 0)
    ]
    ended, cut_off = _counts(begun, length)
    weights = trial_weights(len(begun))
    share = unfinished(ended.sum(axis=0), cut_off.sum(axis=0))
    return {
        'visit': n + 1,
        'completed': sorted(count for v in begun for count in v.completed),
        'cut_off_after': sorted(v.open for v in begun if v.open),
        **_median(share, unfinished(weights @ ended, weights @ cut_off)),
    }


def _median(share: NDArray[np.float64], resampled: NDArray[np.float64]) -> dict[str, float | None]:
    bounds = np.percentile(median_length(resampled), [2.5, 97.5], method='inverted_cdf')
    found = {'median': median_length(share), 'low': bounds[0], 'high': bounds[1]}
    return {key: float(value) if isfinite(value) else None for key, value in found.items()}


def _counts(
    visits: Sequence[Visits], length: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return completed and cut-off visits (trials, length) by their number of segments."""
    ended, cut_off = np.zeros((2, len(visits), length))
    for row, visit in enumerate(visits):
        for count in visit.completed:
            ended[row, count - 1] += 1.0
        if visit.open:
            cut_off[row, visit.open - 1] += 1.0
    return ended, cut_off
