# SPDX-License-Identifier: Apache-2.0
"""One version of the network's recurrent weights."""

from dataclasses import dataclass
import struct
import zlib

import numpy as np
from numpy.typing import NDArray

MAX_VERSION = 1_000_000_000
"""Highest version; one update a second takes thirty years to get there."""


@dataclass(frozen=True, eq=False)
class WeightsUpdate:
    """Weights that the adapter has learned, with where they come from.

    Attributes:
        version: number of updates since the prior, at most `MAX_VERSION`; 0 is the prior.
        segment_stamp_ns: identity of the segment learned from [ns]; 0 for the prior.
        matrix: (K, K) float32 weights in [-1, 1]; row = presynaptic neuron k,
            column = postsynaptic neuron i, as w_ki in Tanneberg et al. 2019.

    """

    version: int
    segment_stamp_ns: int
    matrix: NDArray[np.float32]

    def checksum(self) -> int:
        """Return the CRC-32 over version, stamp and matrix, in little-endian byte order."""
        return checksum(self.version, self.segment_stamp_ns, self.matrix)


def checksum(version: int, segment_stamp_ns: int, matrix: NDArray[np.float32]) -> int:
    """Return the CRC-32 that tells whether weights arrived as they were sent.

    Args:
        version: version of the weights.
        segment_stamp_ns: identity of the segment they were learned from [ns].
        matrix: (K, K) float32 weights.

    """
    identity = struct.pack('<qq', version, segment_stamp_ns)
    return zlib.crc32(np.ascontiguousarray(matrix, dtype='<f4').data, zlib.crc32(identity))
