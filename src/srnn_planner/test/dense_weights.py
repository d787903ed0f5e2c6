# SPDX-License-Identifier: Apache-2.0
"""Weights (K, K) of small networks as they are kept: what differs from the prior."""

import numpy as np

from srnn_msgs_py.weights import LearnedWeights
from srnn_planner.core.synapses import Synapses


def learned(neurons, weights):
    """Return what weights (K, K) of a network have learned."""
    return Synapses.of(neurons.prior, weights).learned


def every(weights, prior=0):
    """Return weights (K, K) of no particular network, all of them learned."""
    count = len(weights)
    return LearnedWeights(count, prior, np.arange(count**2), weights.ravel())
