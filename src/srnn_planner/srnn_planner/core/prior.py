# SPDX-License-Identifier: Apache-2.0
"""The weights that learning starts from, by how far apart two neurons are on the grid."""

import zlib

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.grid import Grid, Indices
from srnn_planner.core.parameters import NetworkParameters

RESOLUTION = 2.0**-20
"""A Gaussian below this is none: what remains is the offset alone."""


class PriorWeights:
    """w = clip(gain * exp(-d^2 / 2 sigma^2) - offset, -1, 1), a uniform prior over directions.

    Tanneberg et al. 2019, "Online Adaptation of the Recurrent Layer". Every node computes it
    by itself; what is kept is one number for each offset, not for each synapse.

    Attributes:
        grid: of the neurons.
        rest: weight between distant neurons.
        reach: neurons farther apart than this along any axis are distant [steps of the grid].
        checksum: tells one prior from another.

    """

    def __init__(self, parameters: NetworkParameters) -> None:
        """Compute the weight for every offset within reach."""
        p = parameters
        self.grid = Grid(p.neurons_per_dimension, p.dimensions)
        spacing = 2.0 / (p.neurons_per_dimension - 1)
        far = p.sigma * np.sqrt(2.0 * max(np.log(p.weight_gain / RESOLUTION), 0.0))
        self.reach = min(int(far / spacing), p.neurons_per_dimension - 1)
        squared = spacing**2 * (self.grid.coordinates**2).sum(axis=1)
        gaussian = p.weight_gain * np.exp(-0.5 * squared / p.sigma**2)
        gaussian[gaussian < RESOLUTION] = 0.0
        self._weights = np.clip(gaussian - p.weight_offset, -1.0, 1.0).astype(np.float32)
        self.rest = np.float32(-p.weight_offset)
        identity = np.array([self.grid.side, self.grid.dimensions], dtype='<i8').tobytes()
        weights = self._weights.astype('<f4').tobytes()
        self.checksum = zlib.crc32(weights, zlib.crc32(identity))

    def at(self, pre: Indices, post: Indices) -> NDArray[np.float32]:
        """Return the weights between neurons, combined as NumPy broadcasts them."""
        weights: NDArray[np.float32] = self._weights[self.grid.apart(pre, post)]
        return weights

    def offsets(self) -> tuple[Indices, NDArray[np.float32]]:
        """Return the offsets (n, d) whose weight is not that at rest, by number, and it (n,)."""
        offsets = self.grid.offsets(self.reach)
        weights = self._weights[np.abs(offsets) @ self.grid.strides]
        near = weights != self.rest
        return offsets[near], weights[near]

    def dense(self) -> NDArray[np.float32]:
        """Return all weights (K, K): for small networks."""
        everybody = np.arange(self.grid.count)
        return self.at(everybody[:, None], everybody)
