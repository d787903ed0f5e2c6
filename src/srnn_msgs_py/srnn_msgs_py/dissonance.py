# SPDX-License-Identifier: Apache-2.0
"""What the adapter felt and did about one segment."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Dissonance:
    """The mismatch between a planned segment and its execution; also the acknowledgement.

    The planner takes it as the adapter's word that it is through with this segment.

    Attributes:
        segment_stamp_ns: identity of the segment [ns].
        signal: name of the learning signal, for example ``local``.
        updated: True when the weights were changed.
        weights_version: version of the weights after this segment.
        peak: largest value of the signal, after its limit.
        global_alpha: (T,) float32 global signal per step of the plan, before threshold.
        neuron_peak: (K,) float32 largest value of the signal per neuron.
        update_ms: time that the decision and the update took [ms].

    """

    segment_stamp_ns: int
    signal: str
    updated: bool
    weights_version: int
    peak: float
    global_alpha: NDArray[np.float32]
    neuron_peak: NDArray[np.float32]
    update_ms: float
