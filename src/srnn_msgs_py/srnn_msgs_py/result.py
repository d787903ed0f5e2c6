# SPDX-License-Identifier: Apache-2.0
"""How a segment ended, by name."""

from dataclasses import dataclass, field
from enum import Enum
import zlib


class ResultCode(Enum):
    """The five ways a segment can end."""

    DONE = 'DONE'
    BLOCKED = 'BLOCKED'
    REJECTED = 'REJECTED'
    STALE = 'STALE'
    FAULT = 'FAULT'


@dataclass(frozen=True)
class SegmentResult:
    """Result of the segment with identity `stamp_ns`.

    Attributes:
        stamp_ns: identity of the segment [ns].
        code: how it ended.
        reason: cause in words; empty for DONE.
        values: named figures, for example the contact force [N].

    """

    stamp_ns: int
    code: ResultCode
    reason: str = ''
    values: dict[str, float] = field(default_factory=dict)

    def digest(self) -> int:
        """Return what tells this result of a segment from another one of the same segment."""
        return zlib.crc32(f'{self.code.value} {self.reason}'.encode())
