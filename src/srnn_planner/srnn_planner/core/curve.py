# SPDX-License-Identifier: Apache-2.0
"""A smooth curve through the points of an averaged path."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.arc_length import evenly

DEGREE = 5
STIFFNESS = 0.00003
"""Weight of the mean squared second derivative against the mean squared residual."""


_ORDER = np.arange(DEGREE + 1.0)


@dataclass(frozen=True, eq=False)
class Curve:
    """A polynomial p(s), s from 0 to 1, whose speed |p'(s)| is close to its length.

    Attributes:
        coefficients: (DEGREE + 1, d), row n belongs to s^n.
        length: length of the curve, in the unit of its points.

    """

    coefficients: NDArray[np.float64]
    length: float

    def at(self, s: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
        """Return the curve and its first two derivatives by s at (n,), each (n, d)."""
        powers = _powers(s)
        first = powers[:, :-1] @ (_ORDER[1:, None] * self.coefficients[1:])
        second = powers[:, :-2] @ ((_ORDER * (_ORDER - 1))[2:, None] * self.coefficients[2:])
        return powers @ self.coefficients, first, second


def fit(points: NDArray[np.float64]) -> Curve:
    """Fit a curve to the points (T, d) of a path; it starts at points[0].

    A polynomial of degree 5 with little bending: the average of sampled movements is
    smooth but for noise from step to step, which must not reach the arm's
    accelerations. First fitted over the steps, then once more at even distances along
    itself, so that constant speed along the curve is constant progress of s.
    """
    first, _ = evenly(_polynomial(points), len(points))
    second, length = evenly(_polynomial(first), len(points))
    return Curve(_polynomial(second), length)


def _polynomial(points: NDArray[np.float64]) -> NDArray[np.float64]:
    coefficients = np.empty((DEGREE + 1, points.shape[1]))
    coefficients[0] = points[0]
    coefficients[1:] = _projection(len(points)) @ (points[1:] - points[0])
    return coefficients


def _powers(s: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (n, DEGREE + 1): 1, s, s^2 and so on."""
    powers = np.ones((len(s), DEGREE + 1))
    for order in range(DEGREE):
        powers[:, order + 1] = powers[:, order] * s
    return powers


@lru_cache(maxsize=8)
def _projection(count: int) -> NDArray[np.float64]:
    """Return (DEGREE, count - 1): offsets from the first point to coefficients."""
    s = np.linspace(0.0, 1.0, count)[1:, None]
    powers = np.arange(1, DEGREE + 1)
    vandermonde = s**powers
    # Integral over [0, 1] of the product of two second derivatives of s^n and s^m.
    bend = powers * (powers - 1)
    exponent = powers[:, None] + powers[None, :] - 3
    energy = np.where(exponent > 0, np.outer(bend, bend) / np.maximum(exponent, 1), 0.0)
    normal = vandermonde.T @ vandermonde / count + STIFFNESS * energy
    return np.asarray(np.linalg.solve(normal, vandermonde.T / count))
