# SPDX-License-Identifier: Apache-2.0
"""Where the network has changed: average change of synaptic input and output, neuron by neuron."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from srnn_config.geometry import clearance
from srnn_experiments.evaluation.place import neuron_positions, place
from srnn_experiments.evaluation.trials import LEARNING, Evaluation, Trial
from srnn_experiments.intervals import describe

CHANGED = 1e-3
"""A neuron has changed when the mean of its synapses has moved by this."""


def numbers(evaluation: Evaluation) -> dict[str, Any]:
    """Return the change of every neuron, the mean over trials, and how focused it is."""
    base = evaluation.base
    positions = np.array(neuron_positions(base))
    model = base.brain.model
    spacing = 2.0 * model.workspace.half_extent / (model.network.neurons_per_dimension - 1)
    near = clearance(positions, base.scene.obstacles) <= spacing
    return {
        **evaluation.known('local'),
        'place': place(base.scene),
        'neurons_m': positions.tolist(),
        'near_m': spacing,
        'signals': {name: _signal(evaluation.trials[name], near) for name in LEARNING},
    }


def mean_change(trials: Sequence[Trial], side: str) -> list[float]:
    """Return the mean over trials of the change (K,) of the neurons' `input` or `output`."""
    found: list[float] = np.mean([trial['change'][side] for trial in trials], axis=0).tolist()
    return found


def share_near(change: NDArray[np.float64], near: NDArray[np.bool_]) -> float | None:
    """Return which share of the change (K,) lies at the neurons `near`; None without change."""
    total = float(np.abs(change).sum())
    return float(np.abs(change[near]).sum()) / total if total > 0.0 else None


def headline(found: dict[str, Any]) -> str:
    """Return the finding in one line."""
    parts = [
        f'{signal["near"]["mean"]:.0%} ({name})'
        for name, signal in found['signals'].items()
        if signal['near'] is not None
    ]
    return (
        f'Change of input that lies close to an obstacle: {", ".join(parts)}'
        if parts
        else 'The network has not changed'
    )


def caption(found: dict[str, Any]) -> str:
    """Return what the figure shows, in words."""
    return (
        'Average change of synaptic input (colour) and output (size of the circles) of every '
        f'neuron, mean over {len(found["seeds"])} trials of {found["segments"]} segments, the '
        'same scales on both sides. Close to an obstacle: neurons within '
        f'{1e3 * found["near_m"]:.0f} mm, the distance of neurons. The paper gives no number but '
        'an example: input changed by -0.03.'
    )


def key_numbers(found: dict[str, Any]) -> list[str]:
    """Return a line for each signal."""
    lines = []
    for name, signal in found['signals'].items():
        changed, near = signal['changed'], signal['near']
        text = (
            f'{name}: strongest mean change of input {signal["strongest_input"]:+.3f}, of output '
            f'{signal["strongest_output"]:+.3f}; input of {changed["mean"]:.1f} ± '
            f'{changed["sd"]:.1f} neurons changed by more than {CHANGED:g}'
        )
        if near is not None:
            text += (
                f'; {near["mean"]:.0%} [{near["low"]:.0%}, {near["high"]:.0%}] of all change of '
                'input close to an obstacle'
            )
        lines.append(f'{text}; {signal["unchanged_trials"]} trials without any change')
    return lines


def _signal(trials: Sequence[Trial], near: NDArray[np.bool_]) -> dict[str, Any]:
    received, sent = mean_change(trials, 'input'), mean_change(trials, 'output')
    each = [np.array(trial['change']['input']) for trial in trials]
    shares = [share for change in each if (share := share_near(change, near)) is not None]
    return {
        'input': received,
        'output': sent,
        'strongest_input': max(received, key=abs),
        'strongest_output': max(sent, key=abs),
        'changed': describe([float((np.abs(change) > CHANGED).sum()) for change in each]),
        'near': describe(shares) if shares else None,
        'unchanged_trials': len(each) - len(shares),
    }
