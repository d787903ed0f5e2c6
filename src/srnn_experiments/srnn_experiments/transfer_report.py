# SPDX-License-Identifier: Apache-2.0
"""What all trials of the transfer experiment showed together."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any

from srnn_experiments.estimates import share_estimate
from srnn_experiments.intervals import describe
from srnn_experiments.transfer_trial import TargetTrial

OVERALL, SOUND = 'all', 'all, if phase 1 learned'
"""Rows of the trials of all rows, and of those that start from weights that were learned well."""

SHARE_TARGET, MEDIAN_TARGET = 0.9, 3
"""Least share of trials that learn with few contacts, and greatest median of contacts."""


@dataclass(frozen=True)
class Row:
    """Trials in one target world, seed by seed.

    Attributes:
        transferred: they start from the weights that phase 1 of the same seed has learned.
        scratch: they start from the prior weights.
        source_learned: whether phase 1 has learned.

    """

    transferred: Sequence[TargetTrial]
    scratch: Sequence[TargetTrial]
    source_learned: Sequence[bool]


def table(rows: Mapping[str, Row]) -> dict[str, dict[str, Any]]:
    """Return the statistics of every row and, last, `OVERALL` and, if there are any, `SOUND`."""
    trials = [
        trial
        for row in rows.values()
        for trial in zip(row.transferred, row.scratch, row.source_learned, strict=True)
    ]
    groups = {OVERALL: trials, SOUND: [trial for trial in trials if trial[2]]}
    together = {name: Row(*zip(*group, strict=True)) for name, group in groups.items() if group}
    return {name: statistics(row) for name, row in {**rows, **together}.items()}


def statistics(row: Row) -> dict[str, Any]:
    """Return the statistics of a row.

    Shares and means have their 95 % intervals. ``few`` is the share of trials that learned
    with no more contacts than the paper's arm, ``spared`` by how many contacts a trial
    that starts from scratch has more, seed by seed; ``first_touch`` is None if the new
    obstacle was never touched; ``targets`` tells what was aimed at and whether it was met.
    """
    trials = row.transferred
    first = [trial.new[0] for trial in trials if trial.new]
    found: dict[str, Any] = {
        **_start(trials),
        'few': share_estimate(sum(trial.few for trial in trials), len(trials)),
        'first_touch': _counts(first) if first else None,
        'nothing_touched': sum(len(trial.nothing) for trial in trials),
        'updates': describe([trial.updates for trial in trials]),
        'source_learned': share_estimate(sum(row.source_learned), len(trials)),
        'scratch': _start(row.scratch),
        'spared': describe(
            [a.contacts - b.contacts for a, b in zip(row.scratch, trials, strict=True)]
        ),
    }
    found['targets'] = {
        'few': found['few']['share'] >= SHARE_TARGET,
        'median': found['new']['median'] <= MEDIAN_TARGET,
        'old': found['old']['total'] == 0,
    }
    return found


def _start(trials: Sequence[TargetTrial]) -> dict[str, Any]:
    """Return what is told of trials with and without transfer."""
    return {
        'trials': len(trials),
        'learned': share_estimate(sum(trial.learned for trial in trials), len(trials)),
        'new': _counts([len(trial.new) for trial in trials]),
        'old': _counts([len(trial.old) for trial in trials]),
        'old_untouched': share_estimate(sum(not trial.old for trial in trials), len(trials)),
        'laps': describe([trial.laps for trial in trials]),
    }


def _counts(values: Sequence[int]) -> dict[str, float]:
    return {
        'median': median(values),
        'min': min(values),
        'max': max(values),
        'total': sum(values),
        **describe(values),
    }
