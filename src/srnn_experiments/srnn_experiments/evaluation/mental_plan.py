# SPDX-License-Identifier: Apache-2.0
"""The mental plan over time, beside what was executed: before, while and after learning."""

from collections.abc import Sequence
from typing import Any

from srnn_experiments.evaluation.place import place
from srnn_experiments.evaluation.trials import LEARNING, Evaluation, Trial

SHOWN = 60
"""Segments from the start of a trial that are shown over time."""

PHASES = ('before', 'while', 'after')


def numbers(evaluation: Evaluation) -> dict[str, Any]:
    """Return paths and phases of the first trial of every learning signal."""
    first = {name: evaluation.trials[name][0] for name in LEARNING}
    return {
        **evaluation.known('local'),
        'seeds': [evaluation.seeds[0]],
        'shown_segments': min(SHOWN, evaluation.base.segments),
        'place': place(evaluation.base.scene),
        'trials': {name: _trial(trial) for name, trial in first.items()},
    }


def phases(touched: Sequence[bool], updated: Sequence[bool]) -> list[str]:
    """Return for every segment whether it lies before, while or after learning.

    Learning lasts from the first touch or update to the last update; a trial that never
    updates is never after it.
    """
    events = [i for i, pair in enumerate(zip(touched, updated, strict=True)) if any(pair)]
    updates = [i for i, changed in enumerate(updated) if changed]
    first = events[0] if events else len(updated)
    last = updates[-1] if updates else len(updated)
    return [PHASES[(i >= first) + (i > last)] for i in range(len(updated))]


def headline(found: dict[str, Any]) -> str:
    """Return the finding in one line."""
    parts = []
    for name, trial in found['trials'].items():
        after = _after(trial)
        parts.append(
            f'{name} {after["touched"]} of {after["segments"]} segments touch and '
            f'{after["reached"]} reach a way point'
        )
    return f'After learning: {", ".join(parts)}'


def caption(found: dict[str, Any]) -> str:
    """Return what the figure shows, in words."""
    return (
        'Mental plan and executed path over time, for the first trial of each signal '
        f'(seed {found["seeds"][0]}, not chosen), its first {found["shown_segments"]} segments, '
        'way point that attracts in grey; right: all mental plans of the trial in the plane. '
        'Time is the planned execution time, so that both paths of a segment stand above each '
        'other; after a touch the arm stays where it was stopped while the plan goes on. '
        'Learning lasts from the first touch to the last update of the trial.'
    )


def key_numbers(found: dict[str, Any]) -> list[str]:
    """Return a line for each signal."""
    lines = []
    for name, trial in found['trials'].items():
        count = {phase: trial['phases'].count(phase) for phase in PHASES}
        after = _after(trial)
        lines.append(
            f'{name}: {sum(trial["touched"])} touches, {sum(trial["updated"])} updates and '
            f'{sum(trial["reached"])} way points reached in {len(trial["touched"])} segments, '
            f'of which {count["before"]} before, {count["while"]} while and {count["after"]} '
            f'after learning; after it {after["touched"]} touches and {after["reached"]} way '
            'points reached'
        )
    return lines


def _after(trial: dict[str, Any]) -> dict[str, int]:
    """Return segments after learning, and how many of them touched and reached."""
    late = [i for i, phase in enumerate(trial['phases']) if phase == 'after']
    counts = {name: sum(trial[name][i] for i in late) for name in ('touched', 'reached')}
    return {'segments': len(late), **counts}


def _trial(trial: Trial) -> dict[str, Any]:
    trace, paths = trial['trace'], trial['paths']
    return {
        'active': trace['active'],
        'touched': trace['touched'],
        'updated': trace['updated'],
        'reached': trace['reached'],
        'phases': phases(trace['touched'], trace['updated']),
        'times_s': paths['times'],
        'plans_m': paths['plans'],
        'executed_m': paths['executed'],
    }
