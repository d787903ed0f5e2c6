# SPDX-License-Identifier: Apache-2.0
"""Numpy arrays into and out of sequence fields, without touching single elements."""

from array import array
from collections.abc import MutableSequence, Sequence

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.errors import MessageError


def doubles(values: NDArray[np.float64]) -> MutableSequence[float]:
    """Return any array flattened as the sequence of a float64[] field."""
    sequence = array('d')
    sequence.frombytes(np.asarray(values, dtype=np.float64).tobytes())
    return sequence


def floats(values: NDArray[np.float32]) -> MutableSequence[float]:
    """Return any array flattened as the sequence of a float32[] field."""
    sequence = array('f')
    sequence.frombytes(np.asarray(values, dtype=np.float32).tobytes())
    return sequence


def vector(sequence: Sequence[float], length: int, field: str) -> NDArray[np.float64]:
    """Return a float64[] field as a read-only array (length,) of finite numbers.

    Raises:
        MessageError: the length is another one, or a number is not finite.

    """
    if len(sequence) != length:
        raise MessageError(f'{field} has {len(sequence)} values: must be {length}')
    values = np.array(sequence, dtype=np.float64)
    require_finite(values, field)
    values.setflags(write=False)
    return values


def require_finite(values: NDArray[np.floating], field: str) -> None:
    """Refuse not-a-number and infinity.

    Raises:
        MessageError: naming the first position that is not finite.

    """
    if not np.isfinite(values).all():
        where = np.argwhere(~np.isfinite(values))[0].tolist()
        raise MessageError(f'{field}{where} = {values[tuple(where)]}: must be finite')
