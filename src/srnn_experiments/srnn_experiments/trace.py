# SPDX-License-Identifier: Apache-2.0
"""What a trial leaves for the figures of an evaluation, as plain data."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from srnn_experiments.segment_record import SegmentRecord
from srnn_planner.core.dissonance import Mismatch, experienced, learning_signal, local_signal
from srnn_planner.core.parameters import LearningParameters, ModelParameters
from srnn_planner.core.state_neurons import StateNeurons

OWN_MAGNITUDE = ('global', 'local')
"""Signals that say how much is learned; the others learn at a constant rate."""

_METRES, _SIGNAL = 5, 7
"""Decimals that are kept: 10 micrometres, and far less than any threshold."""


def trace(
    records: Sequence[SegmentRecord], invalid_plans: Sequence[int], model: ModelParameters
) -> dict[str, Any]:
    """Return what happened segment by segment.

    Args:
        records: segments of the trial, in order.
        invalid_plans: how many there were until each of them was over.
        model: network and learning of the trial.

    Returns:
        Lists with an entry for every segment: `active` (way point), `reached`, `touched`,
        `updated`, `planned_m` (length of the planned path), `invalid_plans`,
        `global_peak` [units^2] and `local_peak` (largest dissonance, before threshold and
        limit, whatever was learned with). Besides, `signals`: every learning signal that
        was used, one for each step (global) or step and neuron (local), in order.

    """
    neurons = StateNeurons(model.network)
    global_peak, local_peak, signals = list[float](), list[float](), list[float]()
    for record in records:
        mismatch = experienced(model, neurons, record.plan.positions, record.executed.positions)
        local = local_signal(mismatch, model.learning.local_scale)
        global_peak.append(float(mismatch.squared_distance.max()))
        local_peak.append(float(local.max(initial=0.0)))
        signals += used_signals(mismatch, model.learning).tolist()
    return {
        'active': [record.before.active for record in records],
        'reached': [record.reached for record in records],
        'touched': [record.touched for record in records],
        'updated': [record.updated for record in records],
        'planned_m': _rounded([record.length for record in records], _METRES),
        'invalid_plans': list(invalid_plans),
        'global_peak': _rounded(global_peak, _SIGNAL),
        'local_peak': _rounded(local_peak, _SIGNAL),
        'signals': _rounded(signals, _SIGNAL),
    }


def used_signals(mismatch: Mismatch, learning: LearningParameters) -> NDArray[np.float64]:
    """Return every learning signal (n,) above its threshold, none for a constant rate."""
    if learning.signal not in OWN_MAGNITUDE:
        return np.zeros(0)
    rates = learning_signal(learning).rates(mismatch)
    # The global signal is one number for all neurons.
    used = rates.max(axis=1, initial=0.0) if learning.signal == 'global' else rates
    return used[used > 0.0]


def paths(records: Sequence[SegmentRecord]) -> dict[str, Any]:
    """Return plan and execution of every segment: `times` (T,) [s], `plans` and `executed` [m].

    Paths have shape (T, d); the execution stays where a contact has stopped it.
    """
    return {
        'times': [_rounded(record.plan.times, 4) for record in records],
        'plans': [_rounded(record.plan.positions, _METRES) for record in records],
        'executed': [_rounded(record.executed.positions, _METRES) for record in records],
    }


def _rounded(values: Sequence[float] | NDArray[np.float64], decimals: int) -> Any:
    return np.round(np.asarray(values, dtype=np.float64), decimals).tolist()
