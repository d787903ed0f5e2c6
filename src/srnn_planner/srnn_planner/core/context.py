# SPDX-License-Identifier: Apache-2.0
"""Context neurons: a population around a way point that pulls the random walk there."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.generalized_error import generalized_error
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


def draw_centres(
    target: NDArray[np.float64], parameters: ContextParameters, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Return the positions (N, d) of a population, Gaussian around a way point (d,) [units]."""
    size = (parameters.neurons, len(target))
    return np.asarray(target + parameters.spread * rng.standard_normal(size))


def way_point_population(
    centres: NDArray[np.float64],
    neurons: NDArray[np.float64],
    steps: int,
    parameters: ContextParameters,
    detour: NDArray[np.float64] | float = 0.0,
) -> ContextPopulation:
    """Connect the population of a way point to the state neurons.

    Args:
        centres: (N, d) positions of the context neurons [units].
        neurons: (K, d) preferred positions of the state neurons.
        steps: length T of a segment.
        parameters: shape of the population and of its weights.
        detour: (K,) what the way from each state neuron is longer than the beeline [units].

    Returns:
        Weights that install a gradient towards the target: each context neuron
        contributes its share of a generalized error distribution of the distance
        (Tanneberg et al. 2019, "Motion Planning with Stochastic Recurrent Neural
        Networks"), and a firing probability that is linear in time.

    """
    p = parameters
    longer = np.full(len(neurons), detour, dtype=np.float64)
    share = generalized_error(centres, neurons, longer, p.scale, p.exponent)
    weights = p.amplitude / p.neurons * share
    probability = _ramp(p.spike_probability_start, p.spike_probability_end, steps)
    return ContextPopulation(weights, probability)


@lru_cache(maxsize=8)
def _ramp(first: float, last: float, steps: int) -> NDArray[np.float64]:
    ramp = np.linspace(first, last, steps)
    ramp.flags.writeable = False
    return ramp
