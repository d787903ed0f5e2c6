# SPDX-License-Identifier: Apache-2.0
"""One version of the network's recurrent weights: what was learned beside the prior."""

from dataclasses import dataclass
import struct
import zlib

import numpy as np
from numpy.typing import NDArray

MAX_VERSION = 1_000_000_000
"""Highest version; one update a second takes thirty years to get there."""

MAX_NEURONS = 2**24
"""Numbers up to this one are whole in single precision, in which neurons are named."""


@dataclass(frozen=True, eq=False)
class LearnedWeights:
    """Weights of the synapses that differ from the prior; all others have those of the prior.

    Attributes:
        neurons: number K of neurons.
        prior: CRC-32 of the prior weights that these are beside.
        synapses: (n,) int64, increasing: presynaptic neuron k times K plus postsynaptic
            neuron i.
        values: (n,) float32 weights w_ki in [-1, 1] (Tanneberg et al. 2019).

    """

    neurons: int
    prior: int
    synapses: NDArray[np.int64]
    values: NDArray[np.float32]

    def __len__(self) -> int:
        """Return how many synapses have learned."""
        return len(self.synapses)

    def objection(self) -> str:
        """Return what is wrong with them, in words; empty if nothing is."""
        synapses, values = self.synapses, self.values
        if values.ndim != 1 or values.shape != synapses.shape:
            return f'{values.shape} weights for {synapses.shape} synapses: must be one for each'
        if not 1 <= self.neurons <= MAX_NEURONS:
            return f'neurons = {self.neurons}: must be 1 to {MAX_NEURONS}'
        if not (np.diff(synapses, prepend=-1) > 0).all():
            return 'synapses must increase from 0, each of them once'
        last = int(synapses[-1]) if len(synapses) else 0
        count = int(self.neurons) ** 2
        if last >= count:
            return f'synapse {last}: must be one of 0 to {count - 1}'
        if not np.isfinite(values).all():
            where = int(np.argmin(np.isfinite(values)))
            return f'weight {where} = {values[where]}: must be finite'
        peak = float(np.abs(values).max(initial=0.0))
        return f'weights reach {peak:g} in size: must be in [-1, 1]' if peak > 1.0 else ''

    def same_as(self, other: 'LearnedWeights') -> bool:
        """Tell whether these are the same weights to the last bit."""
        return (self.neurons, self.prior, *self._bytes()) == (
            other.neurons, other.prior, *other._bytes(),
        )  # fmt: skip

    def checksum(self, seed: int = 0) -> int:
        """Return the CRC-32 over all of it, in little-endian byte order, from a seed."""
        value = zlib.crc32(struct.pack('<qq', self.neurons, self.prior), seed)
        for content in self._bytes():
            value = zlib.crc32(content, value)
        return value

    def _bytes(self) -> tuple[bytes, bytes]:
        return (
            np.asarray(self.synapses, dtype='<i8').tobytes(),
            np.asarray(self.values, dtype='<f4').tobytes(),
        )


@dataclass(frozen=True, eq=False)
class WeightsUpdate:
    """Weights that the adapter has learned, with where they come from.

    Attributes:
        version: number of updates since the prior, at most `MAX_VERSION`; 0 is the prior.
        segment_stamp_ns: identity of the segment learned from [ns]; 0 for the prior.
        learned: the weights.

    """

    version: int
    segment_stamp_ns: int
    learned: LearnedWeights

    def checksum(self) -> int:
        """Return the CRC-32 that tells whether weights arrived as they were sent."""
        identity = struct.pack('<qq', self.version, self.segment_stamp_ns)
        return self.learned.checksum(zlib.crc32(identity))
