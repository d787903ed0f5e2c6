# SPDX-License-Identifier: Apache-2.0
"""Joint states straight from the bytes of a bag.

A run has hundreds of them a second, and to make a message of each of them takes longer than
to decide on them; the numbers of all are taken at once. Whatever is not as the nodes of the
workspace send it is left to the general way.
"""

from collections.abc import Iterable, Mapping, Sequence
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


def stamps_ns(messages: Sequence[bytes]) -> NDArray[np.int64]:
    """Return the stamps (n,) of messages that begin with a header [ns]."""
    # Whatever is too short for a stamp has none, and must not shift those of others.
    head = b''.join([data[_BODY:_FRAME].ljust(_STAMP.size, b'\0') for data in messages])
    stamps = np.frombuffer(head, [('seconds', '<i4'), ('nanoseconds', '<u4')])
    whole = stamps['seconds'].astype(np.int64) * SECOND_NS
    return np.asarray(whole + stamps['nanoseconds'], dtype=np.int64)


def last_numbers(messages: Sequence[bytes], count: int) -> Iterable[NDArray[np.float64]]:
    """Return the last `count` numbers (count,) of each message, all that it has if fewer."""
    ends = [data[-8 * count :] for data in messages]
    if all(len(end) == 8 * count for end in ends):
        return np.frombuffer(b''.join(ends), '<f8').reshape(-1, count)
    return [np.frombuffer(end, '<f8', len(end) // 8) for end in ends]


class JointStateBytes:
    """Reads joint states whose names are these, in this order."""

    def __init__(self, names: Sequence[str]) -> None:
        """Know how the names look in CDR; what pads them may be anything."""
        texts = [name.encode() + b'\0' for name in names]
        self._count = _COUNT.pack(len(names))
        self._names = [_COUNT.pack(len(text)) + text for text in texts]

    def columns(
        self, messages: Sequence[bytes], fields: Sequence[str] = FIELDS
    ) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
        """Return which messages it can read, (n,), and what they say.

        Args:
            messages: n joint states.
            fields: which of their fields; each must have a number for each name.

        Returns:
            Which are known, and their numbers (n, fields, names), NaN where not.

        """
        known = np.zeros(len(messages), dtype=bool)
        numbers = np.full((len(messages), len(fields), len(self._names)), np.nan)
        by_length: dict[int, list[int]] = {}
        for place, data in enumerate(messages):
            by_length.setdefault(len(data), []).append(place)
        for length, places in by_length.items():
            left = np.array(places)
            joined = b''.join([messages[place] for place in places])
            block = np.frombuffer(joined, np.uint8).reshape(len(places), length)
            while len(block):
                shape = self._shape(block[0].tobytes())
                if shape is None:
                    left, block = left[1:], block[1:]
                    continue
                same = shape.fits(block)
                if shape.has(fields, len(self._names)):
                    known[left[same]] = True
                    numbers[left[same]] = shape.numbers(block[same], fields)
                left, block = left[~same], block[~same]
        return known, numbers

    def _shape(self, data: bytes) -> '_Shape | None':
        if data[:2] != _LITTLE_ENDIAN:
            return None
        fixed, numbers = [(0, _BODY), (_FRAME, _FRAME + _COUNT.size)], {}
        try:
            (length,) = _COUNT.unpack_from(data, _FRAME)
            at = _aligned(_FRAME + _COUNT.size + length, 4)
            for content in (self._count, *self._names):
                at = _aligned(at, 4)
                if data[at : at + len(content)] != content:
                    return None
                fixed.append((at, at + len(content)))
                at += len(content)
            for field in FIELDS:
                at = _aligned(at, 4)
                (count,) = _COUNT.unpack_from(data, at)
                fixed.append((at, at + _COUNT.size))
                at += _COUNT.size
                if count:
                    at = _aligned(at, 8)
                numbers[field] = slice(at, at + 8 * count)
                at += 8 * count
        except struct.error:
            return None
        return _Shape(data, fixed, numbers) if at <= len(data) else None


class _Shape:
    """Where the numbers of a message are, and the bytes that say so.

    Messages of one sender have the same shape: those of a bag are told apart in a few steps.
    """

    def __init__(
        self, data: bytes, fixed: Sequence[tuple[int, int]], numbers: Mapping[str, slice]
    ) -> None:
        self._fixed = [(edge, np.frombuffer(data[slice(*edge)], np.uint8)) for edge in fixed]
        self._numbers = numbers

    def has(self, fields: Sequence[str], count: int) -> bool:
        """Tell whether each of some fields has so many numbers."""
        places = [self._numbers[field] for field in fields]
        return all(place.stop - place.start == 8 * count for place in places)

    def fits(self, block: NDArray[np.uint8]) -> NDArray[np.bool_]:
        """Tell which messages (n, bytes) of the same length have this shape, (n,)."""
        same = np.ones(len(block), dtype=bool)
        for (start, end), content in self._fixed:
            equal = block[:, start:end] == content
            # All at once is much faster than each, and almost always enough.
            if not equal.all():
                same &= equal.all(axis=1)
        return same

    def numbers(self, block: NDArray[np.uint8], fields: Sequence[str]) -> NDArray[np.float64]:
        """Return the numbers of messages (n, bytes) of this shape, (n, fields, count)."""
        columns = [
            np.ascontiguousarray(block[:, self._numbers[field]]).view('<f8') for field in fields
        ]
        return np.stack(columns, axis=1)


def _aligned(at: int, size: int) -> int:
    return at + (_BODY - at) % size
