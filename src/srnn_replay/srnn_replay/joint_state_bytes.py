# SPDX-License-Identifier: Apache-2.0
"""Joint states straight from the bytes of a bag.

A run has hundreds of them a second, and to make a message of each of them takes longer than
to decide on them. Whatever is not as the nodes of the workspace send it is left to the
general way.
"""

from collections.abc import Sequence
import struct

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.ros.stamp import SECOND_NS

_STAMP = struct.Struct('<iI')
_COUNT = struct.Struct('<I')
_BODY = 4
"""Bytes before the body of a message; alignment counts from there."""

_LITTLE_ENDIAN = b'\x00\x01'
_FRAME = _BODY + _STAMP.size
FIELDS = ('position', 'velocity', 'effort')


def stamp_ns(data: bytes) -> int:
    """Return the stamp of a message that begins with a header [ns]."""
    seconds, nanoseconds = _STAMP.unpack_from(data, _BODY)
    return int(seconds) * SECOND_NS + int(nanoseconds)


class JointStateBytes:
    """Reads joint states whose names are these, in this order."""

    def __init__(self, names: Sequence[str]) -> None:
        """Know how the names look in CDR; what pads them may be anything."""
        texts = [name.encode() + b'\0' for name in names]
        self._count = _COUNT.pack(len(names))
        self._names = [_COUNT.pack(len(text)) + text for text in texts]

    def arrays(self, data: bytes) -> tuple[NDArray[np.float64], ...] | None:
        """Return position, velocity and effort, (n,) or empty; None if it is not known how."""
        if data[:2] != _LITTLE_ENDIAN:
            return None
        try:
            (length,) = _COUNT.unpack_from(data, _FRAME)
            at = _aligned(_FRAME + _COUNT.size + length, 4)
            if data[at : at + _COUNT.size] != self._count:
                return None
            at += _COUNT.size
            for name in self._names:
                at = _aligned(at, 4)
                if data[at : at + len(name)] != name:
                    return None
                at += len(name)
            found = []
            for _ in FIELDS:
                at = _aligned(at, 4)
                (count,) = _COUNT.unpack_from(data, at)
                at += _COUNT.size
                if count:
                    at = _aligned(at, 8)
                found.append(np.frombuffer(data, '<f8', count, at))
                at += 8 * count
        except (struct.error, ValueError):
            return None
        return tuple(found)


def _aligned(at: int, size: int) -> int:
    return at + (_BODY - at) % size
