# SPDX-License-Identifier: Apache-2.0
"""What a planner has imagined for one segment, for whoever looks on."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Imagination:
    """The samples behind a segment, and the spikes behind the samples.

    Attributes:
        segment_stamp_ns: identity of the segment [ns].
        samples: (S, T, d) decoded movements [m].
        kept: (S,) which of them became the segment.
        spikes: (T, K) how many samples of each state neuron spiked in each step, at most 255.

    """

    segment_stamp_ns: int
    samples: NDArray[np.float32]
    kept: NDArray[np.bool_]
    spikes: NDArray[np.uint8]
