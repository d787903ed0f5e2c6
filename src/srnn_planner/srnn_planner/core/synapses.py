# SPDX-License-Identifier: Apache-2.0
"""Recurrent weights: those of the prior, and beside them what was learned."""

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.weights import LearnedWeights
from srnn_planner.core.errors import WeightsError
from srnn_planner.core.grid import Indices
from srnn_planner.core.prior import PriorWeights


class Synapses:
    """The weights w[pre, post] of K x K synapses, most of which are those of the prior.

    Attributes:
        prior: the weights before anything was learned.
        learned: those that differ from them.

    """

    def __init__(self, prior: PriorWeights, learned: LearnedWeights | None = None) -> None:
        """Put both together; None: nothing was learned."""
        self.prior = prior
        self.learned = _learned(prior, *_NOTHING) if learned is None else learned

    @staticmethod
    def checked(prior: PriorWeights, learned: LearnedWeights) -> 'Synapses':
        """Put both together if they belong to each other.

        Raises:
            WeightsError: what was learned is of another network, or no weights at all.

        """
        count = prior.grid.count
        if learned.neurons != count:
            raise WeightsError(f'weights of {learned.neurons} neurons: must be of {count}')
        if learned.prior != prior.checksum:
            raise WeightsError(
                f'weights beside the prior {learned.prior:#010x}: must be beside that of this '
                f'network, {prior.checksum:#010x}; it comes from dimensions, '
                f'neurons_per_dimension, sigma, weight_gain and weight_offset'
            )
        objection = learned.objection()
        if objection:
            raise WeightsError(objection)
        return Synapses(prior, learned)

    @staticmethod
    def of(prior: PriorWeights, weights: NDArray[np.float32]) -> 'Synapses':
        """Return the synapses that have weights (K, K).

        Raises:
            WeightsError: wrong shape, a value that is not finite or outside [-1, 1].

        """
        count = prior.grid.count
        if weights.shape != (count, count):
            raise WeightsError(f'weights have shape {weights.shape}: must be ({count}, {count})')
        everywhere = np.arange(count**2)
        synapses = Synapses.beside(prior, everywhere, weights.ravel().astype(np.float32))
        return Synapses.checked(prior, synapses.learned)

    @staticmethod
    def beside(
        prior: PriorWeights, synapses: Indices, weights: NDArray[np.float32]
    ) -> 'Synapses':
        """Return the synapses of a prior, but with weights (n,) at increasing ones (n,)."""
        differs = weights != prior.at(*np.divmod(synapses, prior.grid.count))
        return Synapses(prior, _learned(prior, synapses[differs], weights[differs]))

    @property
    def pre(self) -> Indices:
        """Presynaptic neurons (n,) of what was learned."""
        return np.asarray(self.learned.synapses // self.prior.grid.count)

    @property
    def post(self) -> Indices:
        """Postsynaptic neurons (n,) of what was learned."""
        return np.asarray(self.learned.synapses % self.prior.grid.count)

    @property
    def change(self) -> NDArray[np.float64]:
        """By how much what was learned (n,) differs from the prior."""
        learned = self.learned.values.astype(np.float64)
        return np.asarray(learned - self.prior.at(self.pre, self.post))

    def at(self, synapses: Indices) -> NDArray[np.float32]:
        """Return the weights of increasing synapses (n,), numbered pre * K + post."""
        weights = self.prior.at(*np.divmod(synapses, self.prior.grid.count))
        _, here, there = np.intersect1d(
            synapses, self.learned.synapses, assume_unique=True, return_indices=True
        )
        weights[here] = self.learned.values[there]
        return weights

    def among(self, neurons: Indices) -> NDArray[np.float32]:
        """Return the weights (n, n) between increasing neurons (n,)."""
        weights = self.prior.at(neurons[:, None], neurons)
        place = self._places(neurons)
        pre, post = place[self.pre], place[self.post]
        among = (pre >= 0) & (post >= 0)
        weights[pre[among], post[among]] = self.learned.values[among]
        return weights

    def with_among(self, neurons: Indices, weights: NDArray[np.float32]) -> 'Synapses':
        """Return the same synapses, but with weights (n, n) between increasing neurons (n,)."""
        place = self._places(neurons)
        kept = (place[self.pre] < 0) | (place[self.post] < 0)
        pre, post = np.nonzero(weights != self.prior.at(neurons[:, None], neurons))
        synapses = np.concatenate(
            [self.learned.synapses[kept], neurons[pre] * self.prior.grid.count + neurons[post]]
        )
        values = np.concatenate([self.learned.values[kept], weights[pre, post]])
        # Two runs that increase are merged by a stable sort.
        order = np.argsort(synapses, kind='stable')
        return Synapses(self.prior, _learned(self.prior, synapses[order], values[order]))

    def dense(self) -> NDArray[np.float32]:
        """Return all weights (K, K): for small networks."""
        weights = self.prior.dense()
        weights.flat[self.learned.synapses] = self.learned.values
        return weights

    def _places(self, neurons: Indices) -> Indices:
        """Return where each neuron (K,) is among some; -1 where it is not."""
        place = np.full(self.prior.grid.count, -1)
        place[neurons] = np.arange(len(neurons))
        return place


_NOTHING = np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.float32)


def _learned(
    prior: PriorWeights, synapses: Indices, values: NDArray[np.float32]
) -> LearnedWeights:
    synapses.flags.writeable = values.flags.writeable = False
    return LearnedWeights(prior.grid.count, prior.checksum, synapses, values)
