# SPDX-License-Identifier: Apache-2.0
"""The first difference between a recorded decision and the one that was made again."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Difference:
    """Two values that should be the same, bit for bit.

    Attributes:
        where: which of them, for example ``positions[3, 0]``.
        recorded: as it is in the bag.
        replayed: as it was decided again.

    """

    where: str
    recorded: Any
    replayed: Any

    def words(self) -> str:
        """Return both in one line."""
        return f'{self.where}: recorded {_text(self.recorded)}, replayed {_text(self.replayed)}'


def first_difference(recorded: Any, replayed: Any, where: str = '') -> Difference | None:
    """Return the first difference of two values, None if they are the same bit for bit.

    Args:
        recorded: dataclass, array, mapping or plain value.
        replayed: what to compare it with.
        where: what to call them.

    """
    if type(recorded) is not type(replayed):
        return Difference(where, recorded, replayed)
    if isinstance(recorded, np.ndarray):
        return _of_arrays(recorded, replayed, where)
    if is_dataclass(recorded):
        names = [field.name for field in fields(recorded)]
        pairs = [(_join(where, n), getattr(recorded, n), getattr(replayed, n)) for n in names]
    elif isinstance(recorded, Mapping):
        if recorded.keys() != replayed.keys():
            return Difference(where, sorted(recorded), sorted(replayed))
        pairs = [(_join(where, str(key)), recorded[key], replayed[key]) for key in recorded]
    else:
        same = _bits(recorded) == _bits(replayed)
        return None if same else Difference(where, recorded, replayed)
    found = (first_difference(one, other, name) for name, one, other in pairs)
    return next((difference for difference in found if difference is not None), None)


def _of_arrays(recorded: Any, replayed: Any, where: str) -> Difference | None:
    if recorded.shape != replayed.shape or recorded.dtype != replayed.dtype:
        kinds = [f'{array.dtype} {array.shape}' for array in (recorded, replayed)]
        return Difference(where, *kinds)
    if recorded.tobytes() == replayed.tobytes():
        return None
    one, other = np.ascontiguousarray(recorded), np.ascontiguousarray(replayed)
    # Bits, because a zero has two signs and no NaN equals itself.
    kind = f'u{one.dtype.itemsize}'
    index = tuple(int(n) for n in np.argwhere(one.view(kind) != other.view(kind))[0])
    place = f'{where}[{", ".join(map(str, index))}]'
    return Difference(place, one[index].item(), other[index].item())


def _bits(value: Any) -> Any:
    return value.hex() if isinstance(value, float) else value


def _join(where: str, name: str) -> str:
    return f'{where}.{name}' if where else name


def _text(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 100 else f'{text[:100]}…'
