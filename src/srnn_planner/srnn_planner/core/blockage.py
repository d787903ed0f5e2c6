# SPDX-License-Identifier: Apache-2.0
"""Where the network believes that it cannot go."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.state_neurons import StateNeurons


class Blockage:
    """What learning and known obstacles have taken from every neuron.

    1 means that nothing excites a neuron any more that did so by the prior.

    Attributes:
        neighbours: (K, K) whether the prior lets neuron k excite neuron i.

    """

    def __init__(self, neurons: StateNeurons, inhibition: NDArray[np.float64]) -> None:
        """Remember the prior.

        Args:
            neurons: grid and prior weights.
            inhibition: (K,) input that known obstacles give to each neuron, at most 0.

        """
        count = len(neurons.positions)
        self._prior = neurons.prior_weights
        self.neighbours = (self._prior > 0.0) & ~np.eye(count, dtype=bool)
        self._share = self.neighbours / np.maximum(self.neighbours.sum(axis=0), 1)
        # No synapse can lose more than 2, from +1 to -1.
        self._known = np.minimum(-inhibition, 2.0)

    def of(self, weights: NDArray[np.float32]) -> NDArray[np.float64]:
        """Return the blockage (K,) of weights (K, K): the root mean square loss of inputs.

        The arm that touches comes from one side and takes the synapses from there; what
        it touches is as solid from the others, hence the square.
        """
        lost = np.maximum(self._prior - weights, 0.0)
        return np.asarray(np.sqrt((lost**2 * self._share).sum(axis=0)) + self._known)

    def around(self, blockage: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the mean blockage (K,) of the neighbours that excite each neuron.

        Activity is a bump as wide as a neuron's reach: it does not fit through a gap
        between blocked neurons, though those in the gap have lost nothing.
        """
        return np.asarray(blockage @ self._share)
