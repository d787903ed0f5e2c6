# SPDX-License-Identifier: Apache-2.0
"""Spikes and beliefs as pixels."""

import matplotlib
import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]

_SPIKES = matplotlib.colormaps['magma']
_BELIEF = matplotlib.colormaps['inferno']

STEP = 12
"""Width of one step in a picture of spikes [pixels]."""


def raster(spikes: NDArray[np.uint8]) -> Pixels:
    """Return spikes (T, K) as a picture (K, 12 T, 3): a row per neuron, time to the right."""
    share = spikes.T / max(int(spikes.max(initial=0)), 1)
    return np.repeat(_colours(_SPIKES, share)[..., :3], STEP, axis=1)


def map_of(inhibition: NDArray[np.float64], pixels: int) -> Pixels:
    """Return a belief (n, m), rows upward, 0 to 1, as a picture (n pixels, m pixels, 4).

    What was not learned is transparent.
    """
    picture = _colours(_BELIEF, inhibition)
    picture[..., 3] = np.round(255.0 * np.clip(2.0 * inhibition, 0.0, 0.9))
    return np.kron(picture[::-1], np.ones((pixels, pixels, 1), np.uint8))


def _colours(colours: matplotlib.colors.Colormap, share: NDArray[np.float64]) -> Pixels:
    return np.asarray(colours(share, bytes=True), np.uint8)
