# SPDX-License-Identifier: Apache-2.0
"""How long the way to a target is, by what was learned."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.blockage import Blockage
from srnn_planner.core.neighbourhood import Neighbourhood
from srnn_planner.core.shortest_way import distances
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses


class Ways:
    """Shortest ways over the synapses of the network.

    A synapse that excites by the prior is a step that the arm can make. The more of its
    weight is lost, and the more of those around it, the longer the step counts.

    Attributes:
        blockage: what is blocked for the network, by its weights.

    """

    def __init__(self, neurons: StateNeurons, inhibition: NDArray[np.float64]) -> None:
        """Collect the steps between neurons.

        Args:
            neurons: grid and prior weights.
            inhibition: (K,) input that known obstacles give to each neuron, at most 0.

        """
        self._positions = neurons.positions
        self._inhibition = inhibition
        self._steps = Neighbourhood(neurons)
        self.blockage = Blockage(self._steps, inhibition)
        self._post = np.repeat(np.arange(len(inhibition)), self._steps.count)
        spacing = 2.0 / (neurons.parameters.neurons_per_dimension - 1)
        self._reach = 1.5 * spacing
        self._untaxed = np.ones(len(self._post))
        self._ends = b'', np.zeros(0)
        self._rested = b'', np.zeros(0)

    def tolls(
        self, synapses: Synapses, blockage: NDArray[np.float64], aversion: float
    ) -> NDArray[np.float64]:
        """Return how many steps each step counts as (E,), by what its synapses have lost.

        Args:
            synapses: the recurrent weights.
            blockage: (K,) of these, see `Blockage.of`.
            aversion: a step whose synapse has lost 1 counts as 1 + aversion steps.

        """
        lost = -self._inhibition[self._post]
        edge = self._steps.edges(synapses.pre, synapses.post)
        lost[edge[edge >= 0]] -= synapses.change[edge >= 0]
        around = self.blockage.around(blockage)
        return np.asarray(1.0 + aversion * (np.clip(lost, 0.0, 2.0) + around[self._post]))

    def remaining(
        self,
        tolls: NDArray[np.float64],
        target: NDArray[np.float64],
        fatigue: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Return the length of the way from each neuron to the target.

        Args:
            tolls: (E,) of every step, see `tolls`.
            target: (d,) [units].
            fatigue: (K,) a step from each neuron counts as this many more.

        Returns:
            (K,) [units].

        """
        return self._distances(tolls, target, fatigue)

    def detour(
        self, remaining: NDArray[np.float64], target: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return by how much the ways (K,) to a target are longer than by the prior.

        Where nothing was learned no way gets longer, so that the field of a way point is
        the one of the prior there.
        """
        key = target.tobytes()
        if self._rested[0] != key:
            rested = np.zeros(len(self._positions))
            self._rested = key, self._distances(self._untaxed, target, rested)
        return np.asarray(np.maximum(remaining - self._rested[1], 0.0))

    def _distances(
        self,
        tolls: NDArray[np.float64],
        target: NDArray[np.float64],
        fatigue: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        steps = self._steps
        return np.asarray(
            distances(
                steps.first, steps.pre, steps.length, tolls, fatigue, self._near(target)
            )
        )

    def _near(self, target: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far each neuron (K,) is from a target, infinite if others are nearer."""
        key = target.tobytes()
        if self._ends[0] != key:
            away = np.linalg.norm(self._positions - target, axis=1)
            within = away <= max(self._reach, float(away.min()))
            self._ends = key, np.where(within, away, np.inf)
        return self._ends[1]
