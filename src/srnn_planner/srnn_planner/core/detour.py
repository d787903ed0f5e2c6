# SPDX-License-Identifier: Apache-2.0
"""How much longer the way to a target has become by what was learned."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.shortest_way import distances
from srnn_planner.core.state_neurons import StateNeurons


class DetourField:
    """Shortest ways over the synapses of the network, learned ones against prior ones.

    A synapse that excites by the prior is a step that the arm can make; the more of its
    weight is lost, the longer the step counts. Where nothing was learned no way gets
    longer, so that the field of a way point is the one of the prior there.
    """

    def __init__(self, neurons: StateNeurons, inhibition: NDArray[np.float64]) -> None:
        """Collect the steps between neurons.

        Args:
            neurons: grid and prior weights.
            inhibition: (K,) input that obstacles give to each neuron, at most 0.

        """
        count = len(neurons.positions)
        steps = (neurons.prior_weights > 0.0) & ~np.eye(count, dtype=bool)
        self._post, self._pre = np.nonzero(steps.T)
        self._first = np.searchsorted(self._post, np.arange(count + 1))
        self._positions = neurons.positions
        step = neurons.positions[self._pre] - neurons.positions[self._post]
        self._length = np.linalg.norm(step, axis=1)
        self._prior = neurons.prior_weights[self._pre, self._post].astype(np.float64)
        self._inhibition = inhibition[self._post]
        spacing = 2.0 / max(neurons.parameters.neurons_per_dimension - 1, 1)
        self._reach = 1.5 * spacing

    def detour(
        self, weights: NDArray[np.float32], target: NDArray[np.float64], aversion: float
    ) -> NDArray[np.float64]:
        """Return what the way from each neuron to the target is longer than by the prior.

        Args:
            weights: (K, K) recurrent weights w[pre, post].
            target: (d,) [units].
            aversion: a step whose synapse has lost 1 counts as 1 + aversion steps.

        Returns:
            (K,) [units], at least 0.

        """
        lost = self._prior - weights[self._pre, self._post] - self._inhibition
        lost = np.clip(lost, 0.0, 2.0)
        away = np.linalg.norm(self._positions - target, axis=1)
        start = np.where(away <= max(self._reach, float(away.min())), away, np.inf)
        learned = distances(
            self._first, self._pre, self._length * (1.0 + aversion * lost), start
        )
        prior = distances(self._first, self._pre, self._length, start)
        return np.asarray(np.maximum(learned - prior, 0.0))
