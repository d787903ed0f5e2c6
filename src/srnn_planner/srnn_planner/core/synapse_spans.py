# SPDX-License-Identifier: Apache-2.0
"""Recurrent weights as the sampler reads them: whole numbers, without what is at rest."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.grid import Indices
from srnn_planner.core.prior import PriorWeights
from srnn_planner.core.synapses import Synapses

FINEST = 20
"""Weights are multiples of 2^-20 at the finest."""

ROOM = 2.0**29
"""Sums of weights stay below this, so that they and `SILENT` fit into 32 bits."""

WIDTH = 16
"""Spans are this many neurons long, or a multiple of it, as registers are."""


class SynapseSpans(NamedTuple):
    """Synapses that differ from those at rest, in spans of consecutive postsynaptic neurons.

    Sums of whole numbers are exact in any order: what a spike has added to a potential, its
    end takes away again to the last bit. Far neurons inhibit each other equally (the offset
    of the prior weights); that part of all potentials is one number times the active neurons.

    By the prior neurons have the same spans, relative to their own number, unless the edge of
    the grid cuts these off: what is kept is one pattern for all that are alike, and one for
    each neuron that has learned.

    All spans have one length, and what is at rest in them is added as zeros: a processor that
    knows how far a loop goes is ahead of it, and one that guesses is not.

    Attributes:
        scale: these whole numbers are weights times this power of two.
        rest: weight of a synapse at rest.
        pattern: (K,) pattern of each presynaptic neuron.
        first: (P + 1,) the spans of pattern p are first[p] ... first[p + 1] - 1.
        start: (n,) postsynaptic neuron that each span begins with, minus the presynaptic one;
            its end may lie beyond K.
        values: (n, length) weight minus that at rest.

    """

    scale: float
    rest: int
    pattern: Indices
    first: Indices
    start: Indices
    values: NDArray[np.int32]

    def dense(self) -> Indices:
        """Return all weights (K, K) as whole numbers."""
        count, length = len(self.pattern), self.values.shape[1]
        weights = np.zeros((count, count + length), dtype=np.int64)
        for k, p in enumerate(self.pattern):
            for n in range(self.first[p], self.first[p + 1]):
                start = k + self.start[n]
                weights[k, start : start + length] += self.values[n]
        return weights[:, :count] + self.rest


class SpanMaker:
    """Makes the spans of the weights of one network."""

    def __init__(self, prior: PriorWeights, others: float) -> None:
        """Take what stays the same.

        Args:
            prior: the weights before anything was learned.
            others: what else a potential can hold, in size, and be compared with.

        """
        self._prior = prior
        self._others = others
        self._offsets, self._weights = prior.offsets()
        self._examples, self._kind = prior.grid.alike(prior.reach)
        self._which, offset = prior.grid.pairs(self._examples, self._offsets)
        self._post = (self._offsets @ prior.grid.strides)[offset]
        self._size = self._weights[offset]
        # By the prior a neuron receives what it sends.
        sent = np.bincount(self._which, np.abs(self._size - prior.rest), len(self._examples))
        self._received = sent[self._kind]
        self._of_prior: tuple[float, _Patterns] = 0.0, _NONE

    def of(self, synapses: Synapses) -> SynapseSpans:
        """Return the spans of synapses beside the same prior."""
        scale = self._scale(synapses)
        if scale != self._of_prior[0]:
            patterns = _patterns(
                len(self._examples), self._which, self._post, self._whole(self._size, scale)
            )
            self._of_prior = scale, patterns
        ours = self._of_prior[1]
        learners = np.flatnonzero(np.bincount(synapses.pre))
        theirs = self._of_learners(synapses, learners, scale)
        pattern = self._kind.copy()
        pattern[learners] = len(ours.first) - 1 + np.arange(len(learners))
        length = max(ours.values.shape[1], theirs.values.shape[1])
        return SynapseSpans(
            scale=scale,
            rest=round(float(self._prior.rest) * scale),
            pattern=pattern,
            first=np.concatenate([ours.first[:-1], ours.first[-1] + theirs.first]),
            start=np.concatenate([ours.start, theirs.start]),
            values=np.concatenate([_widened(p.values, length) for p in (ours, theirs)]),
        )

    def _scale(self, synapses: Synapses) -> float:
        prior, post = self._prior, synapses.post
        before = np.abs(prior.at(synapses.pre, post) - prior.rest)
        more = np.abs(synapses.learned.values - prior.rest) - before
        received = self._received + np.bincount(post, more, minlength=prior.grid.count)
        most = max(float(received.max()) + self._others, 1.0)
        return float(2.0 ** min(FINEST, int(np.floor(np.log2(ROOM / most))) - 1))

    def _whole(self, weights: NDArray[np.float32], scale: float) -> Indices:
        """Return weights as whole numbers, minus that at rest."""
        rest = round(float(self._prior.rest) * scale)
        return np.asarray(np.rint(weights * scale).astype(np.int64) - rest)

    def _of_learners(
        self, synapses: Synapses, learners: Indices, scale: float
    ) -> '_Patterns':
        grid = self._prior.grid
        which, offset = grid.pairs(learners, self._offsets)
        pre = learners[which]
        by_prior = pre * grid.count + pre + (self._offsets @ grid.strides)[offset]
        number = np.concatenate([by_prior, synapses.learned.synapses])
        weights = np.concatenate([self._weights[offset], synapses.learned.values])
        # Two runs that increase are merged by a stable sort; of both, what was learned counts.
        order = np.argsort(number, kind='stable')
        number = number[order]
        last = np.append(np.diff(number) > 0, np.ones(min(len(number), 1), dtype=bool))
        pre, post = np.divmod(number[last], grid.count)
        values = self._whole(weights[order][last], scale)
        place = np.zeros(grid.count, dtype=np.int64)
        place[learners] = np.arange(len(learners))
        return _patterns(len(learners), place[pre], post - pre, values)


class _Patterns(NamedTuple):
    first: Indices
    start: Indices
    values: NDArray[np.int32]


_NONE = _Patterns(
    np.zeros(1, dtype=np.int64), np.zeros(0, dtype=np.int64), np.zeros((0, 0), dtype=np.int32)
)


def _patterns(
    count: int, which: Indices, post: Indices, values: Indices
) -> _Patterns:
    """Return so many patterns of synapses (n,), sorted by pattern and postsynaptic neuron."""
    # What rounding alone makes of a weight at rest is none.
    counts = np.abs(values) > 1
    which, post, values = which[counts], post[counts], values[counts]
    begins = np.ones(len(which), dtype=bool)
    begins[1:] = (np.diff(which) != 0) | (np.diff(post) > WIDTH)
    heads = np.flatnonzero(begins)
    ends = np.append(heads[1:], len(which))[: len(heads)]
    start = post[heads]
    longest = int((post[ends - 1] + 1 - start).max(initial=0))
    table = np.zeros((len(heads), -(-longest // WIDTH) * WIDTH), dtype=np.int32)
    span = np.cumsum(begins) - 1
    table[span, post - start[span]] = values
    first = np.searchsorted(which[heads], np.arange(count + 1))
    return _Patterns(first, start, table)


def _widened(values: NDArray[np.int32], length: int) -> NDArray[np.int32]:
    return np.pad(values, ((0, 0), (0, length - values.shape[1])))
