# SPDX-License-Identifier: Apache-2.0
"""The network that everybody runs: what is simulated when one segment is planned."""

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.context import ContextPopulation, draw_centres, way_point_population
from srnn_planner.core.encoding import draw_history, spike_probability
from srnn_planner.core.parameters import ModelParameters, NetworkParameters, PlanningParameters
from srnn_planner.core.state_neurons import StateNeurons

START = (0.0, 0.0)
"""Where the movements begin [units]."""

TARGET = (0.5, -0.5)
"""The way point [units]."""


@dataclass(frozen=True, eq=False)
class NetworkTask:
    """One network of K state and N context neurons, to be run S times for T steps.

    Attributes:
        network: its parameters.
        positions: (K, d) preferred positions of the state neurons.
        weights: (K, K) recurrent weights w[pre, post].
        context: the context neurons of the way point.
        start: (K,) probability that a state neuron spiked within tau steps before the first.
        samples: S.

    """

    network: NetworkParameters
    positions: NDArray[np.float64]
    weights: NDArray[np.float32]
    context: ContextPopulation
    start: NDArray[np.float64]
    samples: int

    @property
    def steps(self) -> int:
        """Number of steps T."""
        return len(self.context.spike_probability)

    def one_sample(self) -> 'NetworkTask':
        """Return the same network, to be run once."""
        return replace(self, samples=1)

    def history(self, rng: np.random.Generator) -> NDArray[np.int32]:
        """Draw the step of the last spike of each neuron before 0 (S, K)."""
        return draw_history(self.start, self.samples, self.network.tau, rng)


@dataclass(frozen=True, eq=False)
class NetworkRun:
    """One run of the network, all samples of it.

    Attributes:
        seconds: what it took.
        spikes: (T, K) how many of the samples spiked.

    """

    seconds: float
    spikes: NDArray[np.integer]


class NetworkRunner(Protocol):
    """Whatever can run the network."""

    def run(self, seed: int) -> NetworkRun:
        """Run all samples with the random numbers of a seed."""


def standard_task(
    model: ModelParameters, planning: PlanningParameters, seed: int = 0
) -> NetworkTask:
    """Return the task of planning one segment to one way point, with the prior weights.

    Args:
        model: the network.
        planning: samples, steps and context neurons.
        seed: decides where the context neurons lie around the way point.

    """
    neurons = StateNeurons(model.network)
    centres = draw_centres(np.array(TARGET), planning.context, np.random.default_rng(seed))
    context = way_point_population(
        centres, neurons.positions, planning.sampling.steps, planning.context
    )
    start = spike_probability(neurons.responsibilities(np.array([START]))[0], model.learning)
    return NetworkTask(
        model.network, neurons.positions, neurons.prior_weights, context, start,
        planning.sampling.samples,
    )  # fmt: skip
