# SPDX-License-Identifier: Apache-2.0
"""What learning has changed, seen neuron by neuron."""

import numpy as np
from numpy.typing import NDArray


def input_change(
    weights: NDArray[np.float32], prior: NDArray[np.float32]
) -> NDArray[np.float64]:
    """Return the average change (K,) of the synaptic input that each neuron receives."""
    return np.asarray((weights.astype(np.float64) - prior).mean(axis=0))


def output_change(
    weights: NDArray[np.float32], prior: NDArray[np.float32]
) -> NDArray[np.float64]:
    """Return the average change (K,) of the synaptic output that each neuron sends."""
    return np.asarray((weights.astype(np.float64) - prior).mean(axis=1))
