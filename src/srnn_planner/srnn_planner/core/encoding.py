# SPDX-License-Identifier: Apache-2.0
"""Trajectories into spike trains: Poisson processes driven by responsibilities."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.parameters import LearningParameters

RESOLUTION = 2.0**-24
"""Smaller probabilities are 0: random numbers in single precision cannot tell them apart."""


def spike_probability(
    responsibilities: NDArray[np.float64], parameters: LearningParameters
) -> NDArray[np.float64]:
    """Return P[Poisson(lambda) >= spike_count] for responsibilities of any shape.

    lambda = min(rate_scale * omega, rate_limit). Only this probability matters,
    so one uniform number decides a spike (Tanneberg et al. 2019, "Spike Encoding of
    Trajectories").
    """
    rate = np.minimum(parameters.rate_scale * responsibilities, parameters.rate_limit)
    # The sum of rate^n / n! over n < spike_count, without powers.
    below = np.ones_like(rate)
    for n in range(parameters.spike_count - 1, 0, -1):
        below = 1.0 + rate / n * below
    probability = 1.0 - np.exp(-rate) * below
    return np.asarray(np.where(probability < RESOLUTION, 0.0, probability))


def encode(
    probability: NDArray[np.float64], uniforms: NDArray[np.float64], tau: int
) -> NDArray[np.bool_]:
    """Draw one spike train; the plain reference of the compiled encoder.

    Args:
        probability: (T, K) spike probabilities without refractoriness.
        uniforms: (T, K) numbers from [0, 1).
        tau: a neuron that has spiked is silent for this many steps.

    Returns:
        (T, K) spikes; two spikes of a neuron are more than tau steps apart.

    """
    spikes = np.zeros(probability.shape, dtype=bool)
    silent_until = np.zeros(probability.shape[1], dtype=np.int64)
    for t in range(len(probability)):
        spikes[t] = (uniforms[t] < probability[t]) & (silent_until <= t)
        silent_until[spikes[t]] = t + tau + 1
    return spikes


def postsynaptic_potential(spikes: NDArray[np.bool_], tau: int) -> NDArray[np.bool_]:
    """Return v~ (T, K): 1 at t if the neuron spiked within [t - tau, t - 1]."""
    potential = np.zeros_like(spikes)
    for lag in range(1, min(tau, len(spikes) - 1) + 1):
        potential[lag:] |= spikes[:-lag]
    return potential


def draw_history(
    probability: NDArray[np.float64], samples: int, tau: int, rng: np.random.Generator
) -> NDArray[np.int32]:
    """Draw what each neuron did before a segment, from the encoding of a position.

    Args:
        probability: (K,) spike probabilities of the measured position.
        samples: number S of independent histories.
        tau: length of the history [steps].
        rng: source of randomness.

    Returns:
        (S, K) step of the last spike, -tau ... -1, or `NO_SPIKE`. It sets refractory
        state and postsynaptic potential of the first steps, so that planning starts
        where the robot is (Tanneberg et al. 2019, "Online Motion Planning Framework").

    """
    may = np.flatnonzero(probability)
    spikes = rng.random((samples, len(may))) < probability[may]
    when = rng.integers(-tau, 0, size=spikes.shape)
    history = np.full((samples, len(probability)), NO_SPIKE, dtype=np.int32)
    history[:, may] = np.where(spikes, when, NO_SPIKE)
    return history


NO_SPIKE = -1_000_000
"""Step of the last spike of a neuron that has not spiked within reach."""
