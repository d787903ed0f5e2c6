# SPDX-License-Identifier: Apache-2.0
"""What can be kept of a trial on request, besides its figures."""

from collections.abc import Callable, Set
from typing import Any

import numpy as np

from srnn_experiments.setting import Setting
from srnn_experiments.store import pack
from srnn_experiments.trace import paths, trace
from srnn_experiments.trial import Outcome
from srnn_planner.core.synapses import Synapses
from srnn_planner.core.synaptic_change import input_change, output_change

NOTHING: Set[str] = frozenset()

_DECIMALS = 8


def _weights(_: Setting, outcome: Outcome) -> str | None:
    return None if outcome.synapses is None else pack(outcome.synapses.learned)


def _change(setting: Setting, outcome: Outcome) -> dict[str, list[float]] | None:
    after = outcome.synapses
    if after is None:
        return None
    before = Synapses(after.prior, setting.weights)
    changes = {'input': input_change, 'output': output_change}
    return {
        name: np.round(change(after, before), _DECIMALS).tolist()
        for name, change in changes.items()
    }


def _trace(setting: Setting, outcome: Outcome) -> dict[str, Any]:
    return trace(outcome.records, outcome.invalid_plans, setting.brain.model)


def _paths(_: Setting, outcome: Outcome) -> dict[str, Any]:
    return paths(outcome.records)


KEEPSAKES: dict[str, Callable[[Setting, Outcome], Any]] = {
    'change': _change,
    'paths': _paths,
    'trace': _trace,
    'weights': _weights,
}
"""By name: average change of synaptic input and output of every neuron (K,), plans and
executed paths, what happened segment by segment, weights at the end as text. What a trial
does not have is None."""
