# SPDX-License-Identifier: Apache-2.0
"""What learning has changed, seen neuron by neuron."""

import numpy as np
from numpy.typing import NDArray

from srnn_planner.core.grid import Indices
from srnn_planner.core.synapses import Synapses


def input_change(after: Synapses, before: Synapses) -> NDArray[np.float64]:
    """Return the average change (K,) of the synaptic input that each neuron receives."""
    return _mean(after, after.post) - _mean(before, before.post)


def output_change(after: Synapses, before: Synapses) -> NDArray[np.float64]:
    """Return the average change (K,) of the synaptic output that each neuron sends."""
    return _mean(after, after.pre) - _mean(before, before.pre)


def _mean(synapses: Synapses, neurons: Indices) -> NDArray[np.float64]:
    """Return what was learned, averaged over all synapses of each neuron (K,)."""
    count = synapses.prior.grid.count
    return np.asarray(np.bincount(neurons, synapses.change, minlength=count) / count)
