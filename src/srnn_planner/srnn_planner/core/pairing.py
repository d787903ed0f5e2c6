# SPDX-License-Identifier: Apache-2.0
"""Plan and execution find each other by identity, never by order of arrival."""

from collections import OrderedDict
from typing import TypeVar

from srnn_msgs_py.segment import ExecutedPath, Segment

T = TypeVar('T')

KEPT = 16
"""Plans or paths kept while their other half is on its way."""


class Pairing:
    """Keeps what has no partner yet; the oldest is forgotten first."""

    def __init__(self) -> None:
        """Start empty."""
        self._segments: OrderedDict[int, Segment] = OrderedDict()
        self._paths: OrderedDict[int, ExecutedPath] = OrderedDict()

    def segment(self, segment: Segment) -> tuple[Segment, ExecutedPath] | None:
        """Take in a plan; return it with its execution if that has already arrived."""
        path = self._paths.pop(segment.stamp_ns, None)
        if path is not None:
            return segment, path
        _keep(self._segments, segment.stamp_ns, segment)
        return None

    def executed(self, path: ExecutedPath) -> tuple[Segment, ExecutedPath] | None:
        """Take in an execution; return it with its plan if that is known."""
        segment = self._segments.pop(path.stamp_ns, None)
        if segment is not None:
            return segment, path
        _keep(self._paths, path.stamp_ns, path)
        return None


def _keep(store: OrderedDict[int, T], stamp_ns: int, value: T) -> None:
    store[stamp_ns] = value
    while len(store) > KEPT:
        store.popitem(last=False)
