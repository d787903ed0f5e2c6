# SPDX-License-Identifier: Apache-2.0
"""The grid of state neurons: who is how far from whom, in whole steps along each axis."""

from functools import cached_property
import itertools

import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.int64]


class Grid:
    """M^d neurons, numbered with the last axis running fastest.

    Attributes:
        side: number M of neurons along each axis.
        dimensions: d.
        count: number K of neurons.
        strides: (d,) by how much the number grows with a step along each axis.

    """

    def __init__(self, side: int, dimensions: int) -> None:
        """Number the neurons."""
        self.side, self.dimensions = side, dimensions
        self.count = side**dimensions
        self.strides = side ** np.arange(dimensions - 1, -1, -1)

    @cached_property
    def coordinates(self) -> Indices:
        """Return (K, d) index of each neuron along each axis."""
        return np.asarray(np.arange(self.count)[:, None] // self.strides % self.side)

    def offsets(self, reach: int) -> Indices:
        """Return the offsets (n, d) of neurons within `reach` along each axis, by number."""
        reach = min(reach, self.side - 1)
        axis = range(-reach, reach + 1)
        return np.array(list(itertools.product(axis, repeat=self.dimensions)))

    def apart(self, one: Indices, other: Indices) -> Indices:
        """Return by what offset neurons are apart, on whichever side, as its number.

        The arrays are combined as NumPy broadcasts them. The number is that of the neuron that
        lies by this offset from the first.
        """
        coordinates = self.coordinates
        return np.asarray(
            sum(
                np.abs(coordinates[one, axis] - coordinates[other, axis]) * stride
                for axis, stride in enumerate(self.strides)
            )
        )

    def pairs(self, neurons: Indices, offsets: Indices) -> tuple[Indices, Indices]:
        """Return all pairs of neurons (n,) with those at offsets (m, d) that are on the grid.

        Returns:
            Index of the neuron and index of the offset of each pair, sorted.

        """
        inside = np.ones((len(neurons), len(offsets)), dtype=bool)
        own = self.coordinates[neurons]
        for axis in range(self.dimensions):
            there = own[:, axis, None] + offsets[:, axis]
            inside &= (there >= 0) & (there < self.side)
        which, offset = np.nonzero(inside)
        return which, offset

    def alike(self, reach: int) -> tuple[Indices, Indices]:
        """Sort the neurons by where the edge of the grid is within `reach` of them.

        Returns:
            (P,) one neuron of each kind, and (K,) the kind of every neuron.

        """
        low = np.minimum(self.coordinates, reach)
        high = np.minimum(self.side - 1 - self.coordinates, reach)
        kind = np.zeros(self.count, dtype=np.int64)
        for part in (*low.T, *high.T):
            kind = kind * (reach + 1) + part
        _, first, inverse = np.unique(kind, return_index=True, return_inverse=True)
        return first, inverse
