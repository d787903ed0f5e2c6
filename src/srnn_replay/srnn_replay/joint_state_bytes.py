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
        self._shapes: dict[int, _Shape] = {}

    def arrays(self, data: bytes) -> tuple[NDArray[np.float64], ...] | None:
        """Return position, velocity and effort, (n,) or empty; None if it is not known how."""
        shape = self._shapes.get(len(data))
        if shape is None or not shape.is_of(data):
            shape = self._shape(data)
            if shape is None:
                return None
            self._shapes[len(data)] = shape
        return tuple(np.frombuffer(data, '<f8', count, at) for at, count in shape.numbers)

    def _shape(self, data: bytes) -> '_Shape | None':
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
            numbers = []
            for _ in FIELDS:
                at = _aligned(at, 4)
                (count,) = _COUNT.unpack_from(data, at)
                at += _COUNT.size
                if count:
                    at = _aligned(at, 8)
                numbers.append((at, count))
                at += 8 * count
        except struct.error:
            return None
        return _Shape(data, numbers) if at <= len(data) else None


class _Shape:
    """Where the numbers of a message are, and what is around them.

    Messages of one sender have the same shape, and to compare with the last one is faster than
    to find it anew.
    """

    def __init__(self, data: bytes, numbers: Sequence[tuple[int, int]]) -> None:
        self.numbers = tuple(numbers)
        ends = [at + 8 * count for at, count in numbers]
        edges = [(0, _BODY), *zip([_FRAME, *ends], [at for at, _ in numbers], strict=False)]
        self._around = tuple((slice(*edge), data[slice(*edge)]) for edge in edges)

    def is_of(self, data: bytes) -> bool:
        """Tell whether a message of the same length has this shape."""
        return all(data[place] == content for place, content in self._around)


def _aligned(at: int, size: int) -> int:
    return at + (_BODY - at) % size
