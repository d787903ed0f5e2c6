# SPDX-License-Identifier: Apache-2.0
"""Recurrent weights as the sampler reads them: whole numbers, without what is at rest."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FINEST = 20
"""Weights are multiples of 2^-20 at the finest."""

ROOM = 2.0**29
"""Sums of weights stay below this, so that they and `SILENT` fit into 32 bits."""

WIDTH = 16
"""Spans begin and end at multiples of this many neurons, as registers do."""


class SynapseSpans(NamedTuple):
    """Synapses that differ from those at rest, in spans of consecutive postsynaptic neurons.

    Sums of whole numbers are exact in any order: what a spike has added to a potential, its
    end takes away again to the last bit. Far neurons inhibit each other equally (the offset
    of the prior weights); that part of all potentials is one number times the active neurons.

    All spans have one length, and what is at rest in them is added as zeros: a processor that
    knows how far a loop goes is ahead of it, and one that guesses is not.

    Attributes:
        scale: these whole numbers are weights times this power of two.
        rest: weight of a synapse at rest.
        first: (K + 1,) the spans of presynaptic neuron k are first[k] ... first[k + 1] - 1.
        start: (n,) postsynaptic neuron that each span begins with; its end may lie beyond K.
        values: (n, length) weight minus that at rest.

    """

    scale: float
    rest: int
    first: NDArray[np.int64]
    start: NDArray[np.int64]
    values: NDArray[np.int32]

    def dense(self) -> NDArray[np.int64]:
        """Return all weights (K, K) as whole numbers."""
        count = len(self.first) - 1
        weights = np.zeros((count, count + self.values.shape[1]), dtype=np.int64)
        for k in range(count):
            for n in range(self.first[k], self.first[k + 1]):
                start = self.start[n]
                weights[k, start : start + self.values.shape[1]] += self.values[n]
        return weights[:, :count] + self.rest


def synapse_spans(
    weights: NDArray[np.float32], offset: float, others: float
) -> SynapseSpans:
    """Return the spans of weights (K, K).

    Args:
        weights: w[pre, post], in [-1, 1].
        offset: most weights are minus this.
        others: what else a potential can hold, in size, and be compared with.

    """
    rest = np.float32(-offset)
    most = float(np.abs(weights - rest).sum(axis=0, dtype=np.float64).max()) + others
    scale = 2.0 ** min(FINEST, int(np.floor(np.log2(ROOM / max(most, 1.0)))) - 1)
    whole = round(float(rest) * scale)
    relative = np.rint(weights * scale).astype(np.int64) - whole
    # What rounding alone makes of a weight at rest is none.
    pre, post = np.nonzero(np.abs(relative) > 1)
    column = post // WIDTH
    begins = np.ones(len(pre), dtype=bool)
    begins[1:] = (np.diff(pre) != 0) | (np.diff(column) > 1)
    heads = np.flatnonzero(begins)
    tails = np.append(heads[1:], len(pre)) - 1 if len(pre) else heads
    start = column[heads] * WIDTH
    length = int((column[tails] + 1 - column[heads]).max(initial=0)) * WIDTH
    values = np.zeros((len(heads), length), dtype=np.int32)
    span = np.cumsum(begins) - 1
    values[span, post - start[span]] = relative[pre, post]
    first = np.searchsorted(pre[heads], np.arange(len(weights) + 1))
    return SynapseSpans(scale, whole, first, start, values)
