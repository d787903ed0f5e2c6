# SPDX-License-Identifier: Apache-2.0
"""State neurons on a grid, their Gaussian basis and the synapses between them."""

from functools import cached_property
import itertools

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.weights import LearnedWeights
from srnn_planner.core.grid import Indices
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.prior import PriorWeights
from srnn_planner.core.synapses import Synapses


class StateNeurons:
    """K neurons with preferred positions on a uniform grid over [-1, 1]^d.

    Attributes:
        parameters: the network's parameters.
        positions: (K, d) preferred positions p_k, read-only.

    """

    def __init__(self, parameters: NetworkParameters) -> None:
        """Lay the grid out."""
        self.parameters = parameters
        self._axis = np.linspace(-1.0, 1.0, parameters.neurons_per_dimension)
        self.positions: NDArray[np.float64] = np.array(
            list(itertools.product(self._axis, repeat=parameters.dimensions))
        )
        self.positions.flags.writeable = False

    def basis(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the Gaussian basis b_k(x) of points (n, d) as (n, K).

        Tanneberg et al. 2019, equation of b_i; its exponent is printed without the
        minus sign that a Gaussian needs.
        """
        return np.asarray(
            np.exp(-0.5 * _squared_distances(points, self.positions) / self.parameters.sigma**2)
        )

    def responsibilities(
        self, points: NDArray[np.float64], among: Indices | None = None
    ) -> NDArray[np.float64]:
        """Return omega (n, K): the basis at points (n, d), normalised over the neurons.

        The basis is a product over the dimensions, and so are the responsibilities: n d M
        exponentials are taken for M neurons per dimension, not n K.

        Args:
            points: in units.
            among: (m,) return those of these neurons only, as (n, m).

        """
        shares = self._shares(points)
        if among is not None:
            axes = self.prior.grid.coordinates[among].T
            named = [share[:, axis] for share, axis in zip(shares, axes, strict=True)]
            return np.asarray(np.prod(named, axis=0))
        omega, *others = shares
        for share in others:
            omega = (omega[:, :, None] * share[:, None, :]).reshape(len(points), -1)
        return np.asarray(omega)

    def highest_responsibilities(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (K,) what the responsibility of each neuron for points (n, d) is at most."""
        highest, *others = (share.max(axis=0) for share in self._shares(points))
        for share in others:
            highest = np.outer(highest, share).ravel()
        return np.asarray(highest)

    def interpolate(
        self, values: NDArray[np.float64], points: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the mean of values (K,) by the responsibilities of points (n, d), as (n,).

        The plain reference of `GridMean`.
        """
        first, *others = self._shares(points)
        mean = first @ values.reshape(len(self._axis), -1)
        for share in others:
            mean = np.einsum('nm,nmr->nr', share, mean.reshape(*share.shape, -1))
        return np.asarray(mean[:, 0])

    def _shares(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the responsibilities along each axis alone (d, n, M)."""
        distance = (points.T[:, :, None] - self._axis) / self.parameters.sigma
        exponent = -0.5 * distance**2
        # Relative to the nearest neuron, so that a point far outside does not give 0/0.
        basis = np.exp(exponent - exponent.max(axis=2, keepdims=True))
        return np.asarray(basis / basis.sum(axis=2, keepdims=True))

    @cached_property
    def prior(self) -> PriorWeights:
        """The weights that learning starts from."""
        return PriorWeights(self.parameters)

    @cached_property
    def prior_weights(self) -> NDArray[np.float32]:
        """All weights of the prior (K, K), read-only: for small networks."""
        weights = self.prior.dense()
        weights.flags.writeable = False
        return weights

    def synapses(self, learned: LearnedWeights) -> Synapses:
        """Return the synapses of this network that have learned weights, or refuse these.

        Raises:
            WeightsError: they are of another network, or no weights at all.

        """
        return Synapses.checked(self.prior, learned)


def _squared_distances(
    a: NDArray[np.float64], b: NDArray[np.float64]
) -> NDArray[np.float64]:
    difference = a[:, None, :] - b[None, :, :]
    return np.asarray(np.einsum('nkd,nkd->nk', difference, difference))
