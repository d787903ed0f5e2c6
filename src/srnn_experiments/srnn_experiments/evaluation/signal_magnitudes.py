# SPDX-License-Identifier: Apache-2.0
"""The magnitudes of the learning signals that were used, and the update mass they carry."""

from collections.abc import Sequence
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from srnn_experiments.evaluation.trials import LEARNING, Evaluation, Trial
from srnn_experiments.intervals import trial_interval
from srnn_experiments.paper import LARGEST, MASS_OF_LARGEST

BINS = 30


def numbers(evaluation: Evaluation) -> dict[str, Any]:
    """Return histograms of the signals, and the mass that the largest of them carry."""
    learning = evaluation.base.brain.model.learning
    edges = np.linspace(0.0, learning.limit, BINS + 1)
    thresholds = {'global': learning.global_threshold, 'local': learning.local_threshold}
    found = {name: _signal(evaluation.trials[name], edges) for name in LEARNING}
    return {
        **evaluation.known('local'),
        'limit': learning.limit,
        'largest': LARGEST,
        'edges': edges.tolist(),
        'signals': {
            name: {
                'threshold': thresholds[name],
                'paper_mass_of_largest': MASS_OF_LARGEST[name],
                **signal,
            }
            for name, signal in found.items()
        },
        'largest_global_below_largest_local': _below(evaluation),
    }


def mass_of_largest(
    values: NDArray[np.float64], share: float, weights: NDArray[np.float64] | None = None
) -> float:
    """Return which part of the sum of all values the largest of them carry.

    Args:
        values: (n,) signals, at least one > 0.
        share: of the values that count as the largest.
        weights: (n,) how often each value counts; once by default.

    """
    order = np.argsort(values)[::-1]
    counts = np.ones(len(values)) if weights is None else weights[order]
    mass = np.cumsum(counts * values[order])
    number = np.cumsum(counts)
    # A value in which the share ends counts in part.
    return float(np.interp(share * number[-1], [0.0, *number], [0.0, *mass]) / mass[-1])


def cut_of_largest(values: NDArray[np.float64], share: float) -> float:
    """Return the smallest of the largest values (n,); `share` of them, at least one."""
    return float(np.sort(values)[-ceil(share * len(values))])


def headline(found: dict[str, Any]) -> str:
    """Return the finding in one line."""
    parts = [
        f'{signal["mass_of_largest"]["mass"]:.0%} ({name})'
        for name, signal in found['signals'].items()
        if signal['mass_of_largest'] is not None
    ]
    return (
        f'Update mass of the largest {found["largest"]:.0%} of the signals: {", ".join(parts)}'
        if parts
        else 'No signal exceeded its threshold'
    )


def caption(found: dict[str, Any]) -> str:
    """Return what the figure shows, in words."""
    return (
        'Magnitudes of all learning signals above their threshold: global one for each step, '
        f'local one for each step and neuron, of {len(found["seeds"])} trials each. Left: share '
        f'of the signals in each of {len(found["edges"]) - 1} bins; dashed: thresholds. Right: '
        'share of the update mass (sum of the signals) that the largest signals carry; marks: '
        'the paper. Brackets: 95 % bootstrap over whole trials.'
    )


def key_numbers(found: dict[str, Any]) -> list[str]:
    """Return a line for each signal, and how they compare."""
    lines = []
    for name, signal in found['signals'].items():
        mass = signal['mass_of_largest']
        if mass is None:
            lines.append(f'{name}: no signal exceeded its threshold')
            continue
        lines.append(
            f'{name}: {signal["count"]} signals, the largest {found["largest"]:.0%} (from '
            f'{signal["cut_of_largest"]:.3f} on) carry {mass["mass"]:.0%} [{mass["low"]:.0%}, '
            f'{mass["high"]:.0%}] of the update mass (paper '
            f'{signal["paper_mass_of_largest"]:.0%}), {signal["at_limit"]:.1%} stand at the '
            f'limit, largest {signal["largest_signal"]:.3f}'
        )
    below = found['largest_global_below_largest_local']
    if below is not None:
        lines.append(
            f'{below:.0%} (paper: all) of the largest {found["largest"]:.0%} of the global '
            'signals are smaller than every one of the largest '
            f'{found["largest"]:.0%} of the local ones'
        )
    return lines


def _below(evaluation: Evaluation) -> float | None:
    """Return how many of the largest global signals all of the largest local ones exceed."""
    pooled = {name: np.concatenate(_signals(evaluation.trials[name])) for name in LEARNING}
    if not all(map(len, pooled.values())):
        return None
    largest = pooled['global'][pooled['global'] >= cut_of_largest(pooled['global'], LARGEST)]
    return float((largest < cut_of_largest(pooled['local'], LARGEST)).mean())


def _signals(trials: Sequence[Trial]) -> list[NDArray[np.float64]]:
    return [np.array(trial['trace']['signals'], dtype=np.float64) for trial in trials]


def _signal(trials: Sequence[Trial], edges: NDArray[np.float64]) -> dict[str, Any]:
    of_trial = _signals(trials)
    values = np.concatenate(of_trial)
    counts = np.histogram(values, edges)[0]
    found: dict[str, Any] = {
        'count': len(values),
        'counts': counts.tolist(),
        'mass_of_largest': None,
    }
    if not len(values):
        return found
    trial_of = np.repeat(np.arange(len(trials)), [len(each) for each in of_trial])

    def mass(weights: NDArray[np.float64]) -> float:
        # For a resample of trials without any signal the whole stands in.
        each = weights[trial_of]
        return mass_of_largest(values, LARGEST, each if each.any() else None)

    low, high = trial_interval(len(trials), mass)
    cut = cut_of_largest(values, LARGEST)
    shares = np.linspace(0.0, 1.0, 101)
    return {
        **found,
        'mass_of_largest': {'mass': mass_of_largest(values, LARGEST), 'low': low, 'high': high},
        'curve': [[s, mass_of_largest(values, s)] for s in shares[1:].tolist()],
        'cut_of_largest': cut,
        'largest_signal': float(values.max()),
        'at_limit': float((values >= edges[-1]).mean()),
        'signals_per_trial': [each.tolist() for each in of_trial],
    }
