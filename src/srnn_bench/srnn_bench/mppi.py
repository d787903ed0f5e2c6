# SPDX-License-Identifier: Apache-2.0
"""Model predictive path integral control of a point that obeys velocities.

Williams et al. 2017, "Information Theoretic MPC for Model-Based Reinforcement Learning",
algorithm 2, with noise that is piecewise constant over the horizon: white noise of the same
strength averages out, and never gets around an obstacle.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Cost = Callable[[NDArray[np.float64]], NDArray[np.float64]]
"""Cost (K,) of K paths (K, T, 2) [m]: a mean over the T steps, and what their end adds."""


@dataclass(frozen=True)
class MppiParameters:
    """How far and how widely is looked ahead.

    Attributes:
        rollouts: number K of paths that are tried in a step.
        horizon: number T of steps of a path.
        pieces: number of stretches of the horizon in which the noise is constant.
        period: duration of a step [s].
        noise: standard deviation of the velocities, as a share of the largest one.
        temperature: lambda: paths that cost this much more count e times less.

    """

    rollouts: int = 256
    horizon: int = 60
    pieces: int = 6
    period: float = 0.05
    noise: float = 0.6
    temperature: float = 0.02


class Mppi:
    """Chooses the velocity of the next step, and keeps the plan for the steps after it."""

    def __init__(
        self, parameters: MppiParameters, velocity: float, cost: Cost, rng: np.random.Generator
    ) -> None:
        """Begin with the plan to stay.

        Args:
            parameters: how far and how widely is looked ahead.
            velocity: largest speed [m/s].
            cost: what paths cost.
            rng: source of randomness.

        """
        self._p = parameters
        self._velocity = velocity
        self._cost = cost
        self._rng = rng
        self._plan = np.zeros((parameters.horizon, 2))

    def step(self, position: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the position (2,) after the next step from a position (2,) [m]."""
        p = self._p
        sigma = p.noise * self._velocity
        pieces = sigma * self._rng.standard_normal((p.rollouts, p.pieces, 2))
        noise = np.repeat(pieces, -(-p.horizon // p.pieces), axis=1)[:, : p.horizon]
        # The plan itself is one of the paths.
        noise[0] = 0.0
        velocities = self._limited(self._plan + noise)
        paths = position + p.period * np.cumsum(velocities, axis=1)
        # Costs are means over the horizon; so is that of leaving the plan.
        effort = p.temperature * np.einsum('td,ktd->k', self._plan, noise) / sigma**2
        costs = self._cost(paths) + effort / p.horizon
        weights = np.exp(-(costs - costs.min()) / p.temperature)
        mean = np.einsum('k,ktd->td', weights / weights.sum(), noise)
        self._plan = self._limited(self._plan + mean)
        after = position + p.period * self._plan[0]
        self._plan = np.vstack([self._plan[1:], self._plan[-1:]])
        return np.asarray(after)

    def _limited(self, velocities: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return velocities (..., 2), none larger than the largest."""
        speed = np.linalg.norm(velocities, axis=-1, keepdims=True)
        return np.asarray(velocities * np.minimum(1.0, self._velocity / np.maximum(speed, 1e-9)))
