# SPDX-License-Identifier: Apache-2.0
"""Sampling movements by running the network, fast."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core import sampling_kernel
from srnn_planner.core.context import ContextPopulation
from srnn_planner.core.sampling_kernel import Law
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapse_spans import SpanMaker, SynapseSpans
from srnn_planner.core.synapses import Synapses


class Sampler:
    """Samples movements by running the network.

    Attributes:
        law: when a neuron spikes.
        synapses: the weights in use, once there are any.

    """

    def __init__(
        self,
        neurons: StateNeurons,
        bias: NDArray[np.float64],
        context_max: float,
    ) -> None:
        """Take what stays the same.

        Args:
            neurons: the state neurons.
            bias: (K,) input of context neurons that spike all the time, at most 0.
            context_max: largest input that all other context neurons give together.

        """
        network = neurons.parameters
        rare = 0.5 ** np.ceil(np.log2(2.0 * len(bias)))
        self.law = Law(
            tau=network.tau,
            slope=network.slope,
            threshold=network.threshold,
            absolute=network.refractory == 'absolute',
            halvings=int(np.floor(-np.log2(network.spike_probability_max))),
            saturated=float(np.log(network.spike_probability_max)),
            rare=rare,
            seldom=(network.threshold + np.log(rare)) / network.slope,
        )
        self._positions = neurons.positions
        self._bias = bias
        others = float(np.abs(bias).max()) + context_max + abs(self.law.seldom)
        self._spans = SpanMaker(neurons.prior, others)
        self.synapses: SynapseSpans
        self._whole_bias: NDArray[np.int32]

    def use_weights(self, synapses: Synapses) -> None:
        """Run the network with other weights from now on."""
        self.synapses = self._spans.of(synapses)
        self._whole_bias = _whole(self._bias * self.synapses.scale)

    def sample(
        self,
        context: ContextPopulation,
        history: NDArray[np.int32],
        seeds: NDArray[np.uint64],
    ) -> tuple[NDArray[np.uint16], NDArray[np.float64]]:
        """Run the network S times for T steps.

        Args:
            context: the active context population over T steps.
            history: (S, K) step of each neuron's last spike before 0, see `draw_history`.
            seeds: (S,) where the random numbers of each sample begin, see `random_words`.

        Returns:
            spikes: (T, K) how many of the samples spiked.
            activity: (S, tau + T, d + 1) for each step, history included, the sum of the
                positions of the neurons that spiked and, last, their number.

        """
        spikes, activity = sampling_kernel.sample(
            self.synapses, self._whole_bias,
            _whole(context.weights * self.synapses.scale), context.spike_probability,
            history, seeds, self._positions, self.law,
        )  # fmt: skip
        return spikes, activity


def _whole(numbers: NDArray[np.float64]) -> NDArray[np.int32]:
    return np.rint(numbers).astype(np.int32)
