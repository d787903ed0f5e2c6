# SPDX-License-Identifier: Apache-2.0
"""Who excites whom by the prior: the steps that the arm can make."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.grid import Indices
from srnn_planner.core.state_neurons import StateNeurons


class Neighbourhood:
    """Edges from neurons to those that they excite, sorted by the latter.

    The prior is the same in all directions: whoever excites a neuron is excited by it.

    Attributes:
        first: (K + 1,) the edges into neuron i are first[i] ... first[i + 1] - 1.
        pre: (E,) int32 neuron in which each edge begins, increasing for each i.
        length: (E,) distance between its two neurons [units].
        count: (K,) how many excite each neuron.

    """

    def __init__(self, neurons: StateNeurons) -> None:
        """Collect the edges."""
        prior = neurons.prior
        offsets, weights = prior.offsets()
        near = offsets[(weights > 0.0) & offsets.any(axis=1)]
        self._neurons = prior.grid.count
        post, offset = prior.grid.pairs(np.arange(self._neurons), near)
        pre = post + (near @ prior.grid.strides)[offset]
        # Behind all edges there is one more, which is none.
        self._number = np.append(post * self._neurons + pre, self._neurons**2)
        self.first = np.searchsorted(post, np.arange(self._neurons + 1))
        self.pre = pre.astype(np.int32)
        spacing = 2.0 / (prior.grid.side - 1)
        self.length = (spacing * np.linalg.norm(near, axis=1))[offset]
        self.count = np.diff(self.first)

    def edges(self, pre: Indices, post: Indices) -> Indices:
        """Return the edge between neurons (n,); -1 where one does not excite the other."""
        wanted = post * self._neurons + pre
        edge = np.searchsorted(self._number, wanted)
        return np.where(self._number[edge] == wanted, edge, -1)

    def mean(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the mean of values (K,) over those that excite each neuron, 0 without any."""
        senders = np.flatnonzero(values)
        count = self.count[senders]
        # All edges of the senders, one run of them after the other.
        begin = np.repeat(self.first[senders] - np.cumsum(count) + count, count)
        receivers = self.pre[begin + np.arange(len(begin))]
        sent = np.repeat(values[senders], count)
        received = np.bincount(receivers, sent, minlength=self._neurons)
        return np.asarray(received / np.maximum(self.count, 1))
