# SPDX-License-Identifier: Apache-2.0
"""State neurons on a grid, their Gaussian basis and the prior weights between them."""

from functools import cached_property
import itertools

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.errors import WeightsError
from srnn_planner.core.parameters import NetworkParameters


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

    def responsibilities(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return omega (n, K): the basis at points (n, d), normalised over the neurons.

        The basis is a product over the dimensions, and so are the responsibilities: n d M
        exponentials are taken for M neurons per dimension, not n K.
        """
        omega, *others = (self._responsibilities_along(x) for x in points.T)
        for share in others:
            omega = (omega[:, :, None] * share[:, None, :]).reshape(len(points), -1)
        return omega

    def interpolate(
        self, values: NDArray[np.float64], points: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the mean of values (K,) by the responsibilities of points (n, d), as (n,).

        The plain reference of `GridMean`.
        """
        first, *others = (self._responsibilities_along(x) for x in points.T)
        mean = first @ values.reshape(len(self._axis), -1)
        for share in others:
            mean = np.einsum('nm,nmr->nr', share, mean.reshape(*share.shape, -1))
        return np.asarray(mean[:, 0])

    def _responsibilities_along(self, coordinate: NDArray[np.float64]) -> NDArray[np.float64]:
        distance = (coordinate[:, None] - self._axis) / self.parameters.sigma
        return _normalised(-0.5 * distance**2)

    @cached_property
    def prior_weights(self) -> NDArray[np.float32]:
        """Initial weights (K, K), read-only: near neurons excite, distant ones inhibit.

        w = clip(gain * exp(-d^2 / 2 sigma^2) - offset, -1, 1), a uniform prior over
        directions (Tanneberg et al. 2019, "Online Adaptation of the Recurrent Layer").
        """
        p = self.parameters
        gaussian = p.weight_gain * self.basis(self.positions)
        weights = np.clip(gaussian - p.weight_offset, -1.0, 1.0).astype(np.float32)
        weights.flags.writeable = False
        return weights

    def check_weights(self, weights: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return weights fit for this network, or refuse them.

        Raises:
            WeightsError: wrong shape, a value that is not finite or outside [-1, 1].

        """
        count = len(self.positions)
        if weights.shape != (count, count):
            raise WeightsError(f'weights have shape {weights.shape}: must be ({count}, {count})')
        if not np.isfinite(weights).all():
            raise WeightsError('weights hold values that are not finite')
        if np.abs(weights).max() > 1.0:
            raise WeightsError(f'weights reach {np.abs(weights).max():g}: must lie in [-1, 1]')
        return np.ascontiguousarray(weights, dtype=np.float32)


def _normalised(exponent: NDArray[np.float64]) -> NDArray[np.float64]:
    # Relative to the nearest neuron, so that a point far outside does not give 0/0.
    basis = np.exp(exponent - exponent.max(axis=1, keepdims=True))
    return np.asarray(basis / basis.sum(axis=1, keepdims=True))


def _squared_distances(
    a: NDArray[np.float64], b: NDArray[np.float64]
) -> NDArray[np.float64]:
    difference = a[:, None, :] - b[None, :, :]
    return np.asarray(np.einsum('nkd,nkd->nk', difference, difference))
