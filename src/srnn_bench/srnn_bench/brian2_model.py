# SPDX-License-Identifier: Apache-2.0
"""The network in the words of Brian2 (Stimberg, Brette and Goodman 2019)."""

from dataclasses import dataclass
from typing import Any

import brian2 as b2
from brian2 import ms
import numpy as np
from numpy.typing import NDArray

from srnn_bench.network_task import NetworkTask

_NEURONS = """
u : 1
forced : integer (constant)
"""

_THRESHOLD = (
    'timestep(t, dt) == forced or '
    '(timestep(t, dt) >= tau and rand() < clip(exp(slope * u - threshold), 0, limit))'
)

_CONTEXT = """
since : integer
before : integer
change : 1
"""

_CONTEXT_STEP = """
before = since
since = (before + 1) * int(rand() >= probability(t))
change = int(since == 0 and before >= tau) - int(since == tau)
"""


@dataclass(frozen=True, eq=False)
class Brian2Model:
    """S independent copies of the network as one; one step is 1 ms.

    The first tau steps play the history back: who spikes in them is told. The T steps
    after them are those of the task.

    Attributes:
        network: everything that is simulated.
        neurons: S * K state neurons.
        spikes: their spikes.

    """

    network: Any
    neurons: Any
    spikes: Any


def build(task: NetworkTask) -> Brian2Model:
    """Build neurons and synapses, for the code generation that is in force.

    All in single precision, which is as exact as the weights and faster.

    A rectangular postsynaptic potential is added when a neuron has spiked, and taken away
    tau steps later. That of a context neuron, which may spike in any step, begins with the
    first of several spikes and ends tau steps after the last one.
    """
    b2.prefs.core.default_float_dtype = np.float32
    b2.defaultclock.dt = 1 * ms
    network, copies = task.network, task.samples
    count, tau = len(task.positions), network.tau
    constants = {
        'tau': tau, 'slope': network.slope, 'threshold': network.threshold,
        'limit': network.spike_probability_max,
    }  # fmt: skip
    neurons = b2.NeuronGroup(
        copies * count, _NEURONS, threshold=_THRESHOLD, reset=None,
        refractory=(tau + 1) * ms, namespace=constants,
    )  # fmt: skip
    recurrent = _synapses(
        neurons, neurons, task.weights, copies,
        on_pre={'begin': 'u_post += w', 'end': 'u_post -= w'},
        delay={'begin': 0 * ms, 'end': tau * ms},
    )  # fmt: skip
    probability = np.concatenate([np.zeros(tau), task.context.spike_probability])
    context = b2.NeuronGroup(
        copies * len(task.context.weights), _CONTEXT,
        events={'changes': 'change != 0'},
        namespace={'tau': tau, 'probability': b2.TimedArray(probability, dt=1 * ms)},
    )  # fmt: skip
    context.since = tau + 1
    context.run_regularly(_CONTEXT_STEP, dt=1 * ms)
    pull = _synapses(
        context, neurons, task.context.weights, copies,
        on_pre='u_post += change_pre * w', on_event='changes',
    )  # fmt: skip
    spikes = b2.SpikeMonitor(neurons)
    return Brian2Model(b2.Network(neurons, recurrent, context, pull, spikes), neurons, spikes)


def forced(task: NetworkTask, rng: np.random.Generator) -> NDArray[np.int32]:
    """Draw the step (S * K,) of the simulation in which a neuron is told to spike, or -1."""
    return np.maximum(task.history(rng) + task.network.tau, -1).ravel()


def counts(task: NetworkTask, steps: Any, neurons: Any) -> NDArray[np.int64]:
    """Count spikes, given by step of the simulation and neuron, as (T, K)."""
    spikes = np.zeros((task.network.tau + task.steps, len(task.positions)), dtype=np.int64)
    np.add.at(spikes, (np.asarray(steps), np.asarray(neurons) % len(task.positions)), 1)
    return spikes[task.network.tau :]


def _synapses(
    source: Any, target: Any, weights: NDArray[np.floating], copies: int, **options: Any
) -> Any:
    """Connect all to all within each copy, by weights (pre, post)."""
    synapses = b2.Synapses(source, target, 'w : 1', **options)
    pre, post = (indices.ravel() for indices in np.indices(weights.shape))
    copy = np.repeat(np.arange(copies), weights.size)
    synapses.connect(
        i=np.tile(pre, copies) + copy * weights.shape[0],
        j=np.tile(post, copies) + copy * weights.shape[1],
    )
    synapses.w = np.tile(weights.ravel(), copies)
    return synapses
