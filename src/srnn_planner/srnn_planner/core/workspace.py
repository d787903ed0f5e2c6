# SPDX-License-Identifier: Apache-2.0
"""The one door between metres and neuron coordinates."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from srnn_config import Parameters, parameter


@dataclass(frozen=True)
class Workspace(Parameters):
    """A cube of edge 2 * `half_extent` metres, [-1, 1]^d for the neurons."""

    half_extent: float = parameter(
        0.30, unit='m', above=0.0, maximum=10.0,
        doc='Half the edge of the workspace; one unit of the neurons.',
    )

    def to_units(self, metres: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert positions or differences (..., d) from metres to neuron units."""
        return np.asarray(metres, dtype=np.float64) / self.half_extent

    def to_metres(self, units: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert positions or differences (..., d) from neuron units to metres."""
        return np.asarray(units, dtype=np.float64) * self.half_extent
