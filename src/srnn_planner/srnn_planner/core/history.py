# SPDX-License-Identifier: Apache-2.0
"""What has happened to the weights, event by event."""

from enum import Enum

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.weights import WeightsUpdate

LENGTH = 1000
"""Events kept; the oldest are forgotten first."""

RECORD = np.dtype(
    [
        ('kind', 'S8'), ('version', '<i8'), ('from_version', '<i8'), ('segment_stamp_ns', '<i8'),
        ('time_ns', '<i8'), ('peak', '<f4'), ('signal', 'S12'), ('checksum', '<u4'),
    ]
)  # fmt: skip
"""One event: its kind, the version it made and the one that its weights come from, the segment
learned from and the time of the event [ns], the largest value of the learning signal, the
signal's name and the checksum of the weights."""


class Event(Enum):
    """What can happen to the weights."""

    UPDATE = b'update'
    LOAD = b'load'
    REVERT = b'revert'
    REFUSED = b'refused'
    RESTART = b'restart'


class History:
    """The last events.

    Attributes:
        records: (n,) of type `RECORD`, oldest first, n <= `LENGTH`.

    """

    def __init__(self, records: NDArray[np.void] | None = None) -> None:
        """Go on from earlier records, if there are any."""
        self.records = np.zeros(0, RECORD) if records is None else records[-LENGTH:]

    def add(
        self,
        event: Event,
        weights: WeightsUpdate,
        from_version: int,
        time_ns: int,
        peak: float = 0.0,
        signal: str = '',
    ) -> None:
        """Take in one event; `weights` are those in use after it."""
        record = np.array(
            [(
                event.value, weights.version, from_version, weights.segment_stamp_ns, time_ns,
                peak, signal.encode(), weights.checksum(),
            )],
            dtype=RECORD,
        )  # fmt: skip
        self.records = np.concatenate([self.records, record])[-LENGTH:]

    def learned_from(self, stamp_ns: int) -> bool:
        """Tell whether a segment is among those that the weights were updated from."""
        same = self.records['segment_stamp_ns'] == stamp_ns
        return bool((same & (self.records['kind'] == Event.UPDATE.value)).any())
