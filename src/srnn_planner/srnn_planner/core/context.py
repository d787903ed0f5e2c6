# SPDX-License-Identifier: Apache-2.0
"""Context neurons: a population around a way point that pulls the random walk there."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.parameters import ContextParameters


@dataclass(frozen=True, eq=False)
class ContextPopulation:
    """N context neurons that encode one constraint.

    Attributes:
        weights: (N, K) feed-forward weights theta_jk to the state neurons.
        spike_probability: (T,) probability that any of them spikes in a step.

    """

    weights: NDArray[np.float64]
    spike_probability: NDArray[np.float64]


def generalized_error(
    distance: NDArray[np.float64], scale: float, exponent: float
) -> NDArray[np.float64]:
    """Return exp(-(distance / scale)^exponent), 1 at distance 0."""
    return np.asarray(np.exp(-((distance / scale) ** exponent)))


def way_point_population(
    target: NDArray[np.float64],
    neurons: NDArray[np.float64],
    steps: int,
    parameters: ContextParameters,
    rng: np.random.Generator,
) -> ContextPopulation:
    """Place a population around a way point and connect it to the state neurons.

    Args:
        target: (d,) way point in units.
        neurons: (K, d) preferred positions of the state neurons.
        steps: length T of a segment.
        parameters: shape of the population and of its weights.
        rng: draws the positions of the population, Gaussian around the target.

    Returns:
        Weights that install a gradient towards the target: each context neuron
        contributes its share of a generalized error distribution of the distance
        (Tanneberg et al. 2019, "Motion Planning with Stochastic Recurrent Neural
        Networks"), and a firing probability that is linear in time.

    """
    p = parameters
    centres = target + p.spread * rng.standard_normal((p.neurons, len(target)))
    distance = np.linalg.norm(centres[:, None, :] - neurons[None, :, :], axis=2)
    weights = p.amplitude / p.neurons * generalized_error(distance, p.scale, p.exponent)
    probability = np.linspace(p.spike_probability_start, p.spike_probability_end, steps)
    return ContextPopulation(weights, probability)
