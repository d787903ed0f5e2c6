# SPDX-License-Identifier: Apache-2.0
"""What a node has acted on, in order: with it, its decisions can be made again from a bag."""

from dataclasses import dataclass
from enum import IntEnum
import struct
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

COLUMNS = ('deed', 'first', 'second', 'time', 'until')
WIDTH = len(COLUMNS)

_BITS = struct.Struct('<d')
_WHOLE = struct.Struct('<q')


class Deed(IntEnum):
    """What a node has done; what it was done with is named by `first` and `second`.

    Times are seconds of the steady clock of the node, unless said otherwise.
    """

    CONFIGURED = 1
    """Begun from what it was told."""
    RESTORED = 2
    """Gone on from a checkpoint, of version `first`."""
    ACTIVATED = 3
    """Begun to work; the tracker with what has stopped a predecessor, in `first`."""
    DEACTIVATED = 4

    MEASURED = 5
    """Answered joint states `first`, and external torques `second` ns later, at `time`."""
    ASSUMED = 6
    """Answered joint states `first` that had not arrived: those of an arm that follows."""
    OFFERED = 7
    """Judged segment `first`, `time` seconds after it was stamped."""
    SILENT = 8
    """Stopped, since joint states have ceased."""
    STOP = 9
    RESET = 10
    PAUSE = 11
    RESUME = 12

    POSED = 13
    """Heard where the arm is, in pose `first`."""
    EXECUTED = 14
    """Heard how segment `first` was executed."""
    ENDED = 15
    """Heard at `time` the result of segment `first`; `second` tells its text from others."""
    LEARNED = 16
    """Heard what was learned from segment `first`."""
    WEIGHTS = 17
    """Heard of weights of version `first` and checksum `second`."""
    TOUR = 18
    """Heard of way points, with stamp `first`."""
    PLANNED = 19
    """Planned from `time` to `until`; `first` is the segment, 0 if there was none to plan."""
    PLANNED_IN_VAIN = 20
    """Planned from `time` to `until`, and found no valid movement."""
    BLIND = 21
    """Forgotten what was under way, since poses have ceased."""

    PLAN = 22
    """Heard of segment `first`."""
    REFUSED = 23
    """Heard that version `first` of the weights is dead, and `second` is not."""
    LOAD = 24
    """Gone on from weights of elsewhere, as version `first`."""
    REVERT = 25
    """Gone back to the weights that learning began from."""


class Note(Protocol):
    """Takes in a deed and what `Deed` says of its numbers."""

    def __call__(
        self,
        deed: Deed,
        first: int = 0,
        second: int = 0,
        time_s: float = 0.0,
        until_s: float = 0.0,
    ) -> None:
        """Note it."""


def unnoted(*_: object, **__: object) -> None:
    """Keep no journal."""


@dataclass(frozen=True, eq=False)
class Journal:
    """A part of the journal of one process of a node.

    Attributes:
        session: when the process began its journal [ns of system time]; a successor has another.
        index: number of the first row among those of the session.
        rows: (n, 5) int64, columns as in `COLUMNS`; times are the bits of a float64.

    """

    session: int
    index: int
    rows: NDArray[np.int64]


def row(
    deed: Deed, first: int = 0, second: int = 0, time: float = 0.0, until: float = 0.0
) -> tuple[int, int, int, int, int]:
    """Return one row."""
    return int(deed), first, second, bits(time), bits(until)


def bits(value: float) -> int:
    """Return the bits of a number as a whole number."""
    whole: int
    (whole,) = _WHOLE.unpack(_BITS.pack(value))
    return whole


def numbers(column: NDArray[np.int64]) -> list[float]:
    """Return the numbers with these bits, (n,)."""
    values: list[float] = np.ascontiguousarray(column).view(np.float64).tolist()
    return values


def number(whole: int) -> float:
    """Return the number with these bits."""
    value: float
    (value,) = _BITS.unpack(_WHOLE.pack(whole))
    return value
