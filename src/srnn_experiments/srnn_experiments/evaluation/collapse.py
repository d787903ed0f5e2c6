# SPDX-License-Identifier: Apache-2.0
"""Whether the model collapses under a constant rate without a trigger, over many segments."""

from collections.abc import Sequence
from typing import Any

from srnn_experiments.evaluation.place import neuron_positions, place
from srnn_experiments.evaluation.synaptic_change import mean_change
from srnn_experiments.evaluation.trials import (
    RATES,
    TRIGGERED,
    UNTRIGGERED,
    Evaluation,
    Trial,
    constant_rates,
)
from srnn_experiments.figures import LATE
from srnn_experiments.intervals import describe, share_interval

BINS = 20
"""A trial is looked at in this many parts."""

SERIES = ('reached', 'touched', 'invalid_plans', 'planned_m')


def numbers(evaluation: Evaluation) -> dict[str, Any]:
    """Return how trials go over their segments, and in what state they end."""
    width = max(1, evaluation.long // BINS)
    names = constant_rates()
    return {
        **evaluation.known(next(iter(names))),
        'bin_segments': width,
        'late_segments': min(LATE, evaluation.long),
        'rates': list(RATES),
        'triggers': [TRIGGERED, UNTRIGGERED],
        'place': place(evaluation.base.scene),
        'neurons_m': neuron_positions(evaluation.base),
        'settings': {
            name: _setting(evaluation.trials[name], evaluation.long, width) for name in names
        },
    }


def state(trial: Trial, length: int) -> str:
    """Return how a trial of `length` segments ended.

    ``collapsed``: given up, because no valid movement could be sampled any more;
    ``stranded``: it moves on, but did not reach every way point in its last 100 segments;
    ``fine``: neither.
    """
    if trial['segments_executed'] < length:
        return 'collapsed'
    return 'fine' if trial['still_reached'] else 'stranded'


def per_segment(values: Sequence[float], length: int, width: int) -> list[float | None]:
    """Return the mean of whole bins of `width` segments; None where the trial had ended."""
    return [
        sum(values[i : i + width]) / width if i + width <= len(values) else None
        for i in range(0, length - width + 1, width)
    ]


def mean_of_bins(trials: Sequence[Sequence[float | None]]) -> list[float | None]:
    """Return the mean over the trials that went on until the end of each bin."""
    means: list[float | None] = []
    for column in zip(*trials, strict=True):
        known = [value for value in column if value is not None]
        means.append(sum(known) / len(known) if known else None)
    return means


def headline(found: dict[str, Any]) -> str:
    """Return the finding in one line."""
    gone, count = _collapsed(found)
    return (
        f'Without a trigger {gone or "none"} of {count} trials collapsed within '
        f'{found["segments"]} segments'
    )


def caption(found: dict[str, Any]) -> str:
    """Return what the figure shows, in words, and whether the model collapsed."""
    gone, count = _collapsed(found)
    verdict = (
        f'The model collapsed in {gone} of {count} untriggered trials; the others'
        if gone
        else f'The model did not collapse: all {count} untriggered trials'
    )
    return (
        f'{verdict} still sampled valid movements after {found["segments"]} segments (paper: '
        'without a trigger no constant rate was stable, in the end no valid movement could be '
        'sampled). Constant rates, where the global signal triggers or in every step of every '
        f'segment, {len(found["seeds"])} trials each, means of {found["bin_segments"]} segments: '
        'single trials thin, their mean bold, over those that go on; a cross marks where a trial '
        'was given up. Bottom: mean change of the network by the untriggered rate, each on a '
        'scale of its own. Collapsed: given up for want of a valid movement; stranded: moves, '
        f'but does not reach every way point in the last {found["late_segments"]} segments; '
        'fine: neither.'
    )


def key_numbers(found: dict[str, Any]) -> list[str]:
    """Return a line for each setting."""
    lines = []
    for name, setting in found['settings'].items():
        states, late, touches = setting['states'], setting['late_reached'], setting['touches']
        low, high = setting['fine_interval']
        lines.append(
            f'{name}: {states.count("collapsed")} collapsed, {states.count("stranded")} '
            f'stranded, {states.count("fine")} of {len(states)} fine [{low:.0%}, {high:.0%}]; '
            f'{late["mean"]:.1f} ± {late["sd"]:.1f} way points reached in the last '
            f'{found["late_segments"]} segments, {touches["mean"]:.1f} ± {touches["sd"]:.1f} '
            f'touches and {setting["invalid_plans"]["mean"]:.1f} invalid plans per trial, '
            f'strongest mean change of input {setting["strongest_input"]:+.2f}'
        )
    return lines


def _collapsed(found: dict[str, Any]) -> tuple[int, int]:
    """Return how many of the untriggered trials collapsed, and how many there are."""
    untriggered = [s for name, s in found['settings'].items() if name.startswith(UNTRIGGERED)]
    gone = sum(s['states'].count('collapsed') for s in untriggered)
    return gone, sum(len(s['states']) for s in untriggered)


def _setting(trials: Sequence[Trial], length: int, width: int) -> dict[str, Any]:
    states = [state(trial, length) for trial in trials]
    series = {
        name: [per_segment(_per_segment_values(t, name), length, width) for t in trials]
        for name in SERIES
    }
    change = mean_change(trials, 'input')
    return {
        'states': states,
        'fine_interval': share_interval(states.count('fine'), len(states)),
        'segments_executed': [trial['segments_executed'] for trial in trials],
        'late_reached': describe([float(sum(t['trace']['reached'][-LATE:])) for t in trials]),
        'touches': describe([float(trial['contacts']) for trial in trials]),
        'invalid_plans': describe([float(trial['invalid_plans']) for trial in trials]),
        'trials': series,
        'mean': {name: mean_of_bins(each) for name, each in series.items()},
        'input': change,
        'output': mean_change(trials, 'output'),
        'strongest_input': max(change, key=abs),
    }


def _per_segment_values(trial: Trial, name: str) -> list[float]:
    values = trial['trace'][name]
    if name != 'invalid_plans':
        return list(values)
    return [now - before for now, before in zip(values, [0, *values], strict=False)]
