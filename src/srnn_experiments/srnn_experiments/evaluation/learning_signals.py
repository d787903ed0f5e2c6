# SPDX-License-Identifier: Apache-2.0
"""The learning signals over the segments of a trial, and what they triggered."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from srnn_experiments.evaluation.trials import LEARNING, Evaluation, Trial
from srnn_experiments.intervals import describe
from srnn_experiments.paper import TABLE_1

BIN = 10
"""Segments over which the mean of the signal is taken, to be read as a line."""


def numbers(evaluation: Evaluation) -> dict[str, Any]:
    """Return the largest signal of every segment and trial, thresholds and updates."""
    learning = evaluation.base.brain.model.learning
    thresholds = {'global': learning.global_threshold, 'local': learning.local_threshold}
    return {
        **evaluation.known('local'),
        'limit': learning.limit,
        'bin_segments': BIN,
        'signals': {
            name: {
                'threshold': thresholds[name],
                'paper_updates': list(TABLE_1[name].updates),
                **_signal(evaluation.trials[name], f'{name}_peak'),
            }
            for name in LEARNING
        },
    }


def binned_mean(series: Sequence[Sequence[float]], width: int) -> list[float]:
    """Return the mean over trials and over bins of `width` segments; trials may end early."""
    longest = max(map(len, series))
    bins = [[x for one in series for x in one[i : i + width]] for i in range(0, longest, width)]
    return [float(np.mean(values)) for values in bins]


def headline(found: dict[str, Any]) -> str:
    """Return the finding in one line."""
    parts = [
        f'{name} {signal["updates"]["mean"]:.1f} ± {signal["updates"]["sd"]:.1f} '
        f'(paper {signal["paper_updates"][0]:g} ± {signal["paper_updates"][1]:g})'
        for name, signal in found['signals'].items()
    ]
    return f'Updates per trial: {", ".join(parts)}'


def caption(found: dict[str, Any]) -> str:
    """Return what the figure shows, in words."""
    return (
        'Largest learning signal of every segment, before its limit, all '
        f'{len(found["seeds"])} trials (dots, large where it triggered an update) and the mean '
        f'over trials and {found["bin_segments"]} segments (line), with the threshold that '
        'triggers learning. Right: updates so far, every trial and their mean, and mean ± sd of '
        'the paper.'
    )


def key_numbers(found: dict[str, Any]) -> list[str]:
    """Return a line for each signal."""
    lines = []
    for name, signal in found['signals'].items():
        updates, paper, last = signal['updates'], signal['paper_updates'], signal['last_update']
        lines.append(
            f'{name}: {updates["mean"]:.1f} ± {updates["sd"]:.1f} [{updates["low"]:.1f}, '
            f'{updates["high"]:.1f}] updates per trial (paper {paper[0]:g} ± {paper[1]:g}), '
            f'{signal["updates_touched"]} of {signal["updates_all"]} in segments that touched'
            + (f'; last update in segment {last["mean"]:.0f} ± {last["sd"]:.0f}' if last else '')
        )
    return lines


def _signal(trials: Sequence[Trial], peak: str) -> dict[str, Any]:
    traces = [trial['trace'] for trial in trials]
    updates = [[n for n, on in enumerate(t['updated'], 1) if on] for t in traces]
    touches = [[n for n, on in enumerate(t['touched'], 1) if on] for t in traces]
    last = [float(numbers[-1]) for numbers in updates if numbers]
    shared = sum(len(set(u) & set(t)) for u, t in zip(updates, touches, strict=True))
    return {
        'peaks': [trace[peak] for trace in traces],
        'mean_peaks': binned_mean([trace[peak] for trace in traces], BIN),
        'update_segments': updates,
        'touch_segments': touches,
        'updates': describe([float(len(numbers)) for numbers in updates]),
        'updates_all': sum(map(len, updates)),
        'updates_touched': shared,
        'last_update': describe(last) if last else None,
    }
