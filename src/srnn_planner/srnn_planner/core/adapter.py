# SPDX-License-Identifier: Apache-2.0
"""Learning from one executed segment."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.weights import LearnedWeights
from srnn_planner.core import generator_state, plasticity_kernel
from srnn_planner.core.dissonance import (
    AbstractSignal,
    Mismatch,
    experienced,
    learning_signal,
)
from srnn_planner.core.encoding import spike_probability
from srnn_planner.core.errors import PairingError
from srnn_planner.core.parameters import ModelParameters
from srnn_planner.core.plasticity import Experience
from srnn_planner.core.random_words import seeds
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses

FARTHEST = 10.0
"""No arm is farther out than this [units]; responsibilities are not numbers very far out."""


@dataclass(frozen=True, eq=False)
class Lesson:
    """What one segment taught.

    Attributes:
        updated: whether the weights have changed.
        squared_distance: (T,) global dissonance |kappa_m - kappa_e|^2 [units^2].
        neuron_peak: (K,) largest learning rate of each neuron, 0 for those that cannot spike.

    """

    updated: bool
    squared_distance: NDArray[np.float64]
    neuron_peak: NDArray[np.float64]

    @property
    def peak(self) -> float:
        """Largest learning rate of the segment."""
        return float(self.neuron_peak.max())

    def told(self, stamp_ns: int, signal: str, version: int, update_ms: float) -> Dissonance:
        """Return what others are told of the lesson.

        Args:
            stamp_ns: stamp of the segment [ns].
            signal: name of the learning signal.
            version: of the weights that are in use now.
            update_ms: how long it took [ms].

        """
        return Dissonance(
            segment_stamp_ns=stamp_ns,
            signal=signal,
            updated=self.updated,
            weights_version=version,
            peak=self.peak,
            global_alpha=self.squared_distance.astype(np.float32),
            neuron_peak=self.neuron_peak.astype(np.float32),
            update_ms=update_ms,
        )


class Learner:
    """Holds the weights and adapts them to the world, segment by segment.

    Attributes:
        model: network and learning.
        neurons: the state neurons.
        synapses: the weights between them.
        updates: how often they were adapted.
        signal: name of the learning signal.

    """

    def __init__(
        self,
        model: ModelParameters,
        rng: np.random.Generator,
        signal: AbstractSignal | None = None,
    ) -> None:
        """Start from the prior weights.

        Args:
            model: network and learning.
            rng: source of randomness.
            signal: learning signal of one's own; None for the one that the parameters name.

        """
        self.model = model
        self.neurons = StateNeurons(model.network)
        self.synapses = Synapses(self.neurons.prior)
        self.updates = 0
        self.signal = model.learning.signal if signal is None else type(signal).__name__
        self._signal = learning_signal(model.learning) if signal is None else signal
        self._rng = rng

    def warm_up(self) -> None:
        """Compile every kernel, and work through one lesson that teaches nothing."""
        path = np.linspace(np.zeros(self.model.network.dimensions), 0.3, 64)
        mismatch = experienced(self.model, self.neurons, path, path)
        nothing = self._experience(mismatch, 0.0 * mismatch.mental)
        self._replay(nothing, seeds(np.random.default_rng(0), self.model.learning.replays))

    def use_weights(self, learned: LearnedWeights) -> None:
        """Go on from other weights, all or nothing.

        Raises:
            WeightsError: the weights do not fit; the old ones stay.

        """
        self.synapses = self.neurons.synapses(learned)

    def random_state(self) -> NDArray[np.uint64]:
        """Return the state (6,) that the random numbers of the next lesson are drawn from."""
        return generator_state.read(self._rng)

    def use_random_state(self, state: NDArray[np.uint64]) -> None:
        """Draw the random numbers of the next lesson from a state (6,).

        Raises:
            WeightsError: it is none; nothing has changed.

        """
        generator_state.write(self._rng, state)

    def learn(self, mental: NDArray[np.float64], executed: NDArray[np.float64]) -> Lesson:
        """Learn from a plan and its execution.

        Args:
            mental: (T, d) planned positions [m].
            executed: (T, d) measured positions at the same times [m], held after a contact.

        Raises:
            PairingError: the two do not have the same shape, that of the network's space,
                or leave the workspace far behind.

        """
        if mental.shape != executed.shape:
            raise PairingError(f'plan {mental.shape} and execution {executed.shape} differ')
        dimensions = self.model.network.dimensions
        if mental.ndim != 2 or mental.shape[1] != dimensions or not len(mental):
            raise PairingError(f'plan of shape {mental.shape}: must be (T, {dimensions})')
        limit = FARTHEST * self.model.workspace.half_extent
        # A number that is not finite compares as false.
        if not ((np.abs(mental) <= limit).all() and (np.abs(executed) <= limit).all()):
            raise PairingError(f'plan and execution must lie within {limit:g} m')
        mismatch = experienced(self.model, self.neurons, mental, executed)
        rates = self._signal.rates(mismatch)
        updated = bool(rates.any())
        if updated:
            self.synapses = self._replay(
                self._experience(mismatch, rates),
                seeds(self._rng, self.model.learning.replays),
            )
            self.updates += 1
        peak = np.zeros(len(self.neurons.positions))
        peak[mismatch.neurons] = rates.max(axis=0)
        return Lesson(updated, mismatch.squared_distance, peak)

    def _replay(self, experience: Experience, states: NDArray[np.uint64]) -> Synapses:
        """Return what the synapses are after as many replays as there are states."""
        among = experience.neurons
        weights = plasticity_kernel.replay(
            self.synapses.among(among), experience, states, self.model.network.tau
        )
        return self.synapses.with_among(among, weights)

    def _experience(self, mismatch: Mismatch, rates: NDArray[np.float64]) -> Experience:
        learning = self.model.learning
        highest = np.maximum(mismatch.executed.max(axis=0), mismatch.mental.max(axis=0))
        spiking = np.flatnonzero(spike_probability(highest, learning))
        return Experience(
            neurons=mismatch.neurons[spiking],
            executed=spike_probability(mismatch.executed[:, spiking], learning),
            mental=spike_probability(mismatch.mental[:, spiking], learning),
            rates=np.ascontiguousarray(rates[:, spiking]),
        )
