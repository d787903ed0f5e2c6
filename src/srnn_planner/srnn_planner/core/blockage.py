# SPDX-License-Identifier: Apache-2.0
"""Where the network believes that it cannot go."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.neighbourhood import Neighbourhood
from srnn_planner.core.synapses import Synapses


class Blockage:
    """What learning and known obstacles have taken from every neuron.

    1 means that nothing excites a neuron any more that did so by the prior.
    """

    def __init__(self, neighbourhood: Neighbourhood, inhibition: NDArray[np.float64]) -> None:
        """Remember what cannot be learned.

        Args:
            neighbourhood: who excites whom by the prior.
            inhibition: (K,) input that known obstacles give to each neuron, at most 0.

        """
        self._neighbourhood = neighbourhood
        self._share = 1.0 / np.maximum(neighbourhood.count, 1)
        # No synapse can lose more than 2, from +1 to -1.
        self._known = np.minimum(-inhibition, 2.0)

    def of(self, synapses: Synapses) -> NDArray[np.float64]:
        """Return the blockage (K,) of the weights: the root mean square loss of inputs.

        The arm that touches comes from one side and takes the synapses from there; what
        it touches is as solid from the others, hence the square.
        """
        pre, post = synapses.pre, synapses.post
        lost = np.maximum(-synapses.change, 0.0) ** 2
        lost[self._neighbourhood.edges(pre, post) < 0] = 0.0
        received = np.bincount(post, lost * self._share[post], minlength=len(self._share))
        return np.asarray(np.sqrt(received) + self._known)

    def around(self, blockage: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the mean blockage (K,) of the neighbours that excite each neuron.

        Activity is a bump as wide as a neuron's reach: it does not fit through a gap
        between blocked neurons, though those in the gap have lost nothing.
        """
        return self._neighbourhood.mean(blockage)
