# SPDX-License-Identifier: Apache-2.0
"""From a stop on contact to the first segment that was planned with what it taught."""

from dataclasses import dataclass

from srnn_msgs_py.journal import Deed, number
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.ros import result, segment, weights
from srnn_msgs_py.weights import WeightsUpdate
from srnn_replay.recording import Decoded, Recording, Session

TOPICS = ('segment', 'segment_result', 'weights')


@dataclass(frozen=True)
class Lesson:
    """The way of a touch into a segment; all but the identity in ns of system time.

    Attributes:
        stamp_ns: identity of the segment that was stopped.
        stopped_ns: when the tracker sent its result.
        shared_ns: when the adapter sent the weights that it has led to.
        begun_ns: when planning with these weights, or later ones, began.
        sent_ns: when the segment was sent that came of it.

    """

    stamp_ns: int
    stopped_ns: int
    shared_ns: int
    begun_ns: int
    sent_ns: int


def lessons(planner: Recording) -> list[Lesson]:
    """Return the lessons of a run in order; touches that changed no weights teach nothing.

    Args:
        planner: messages of at least `TOPICS`.

    """
    segments = {
        d.value.stamp_ns: d.message.sent_ns for d in planner.decoded('segment', segment.from_msg)
    }
    shared = planner.decoded('weights', weights.from_msg)
    found = []
    for stop in planner.decoded('segment_result', result.from_msg):
        if stop.value.code is not ResultCode.BLOCKED:
            continue
        taught = next((w for w in shared if w.value.segment_stamp_ns == stop.value.stamp_ns), None)
        planned = None if taught is None else _planned(planner, taught, segments)
        if taught is not None and planned is not None:
            times = (stop.message.sent_ns, taught.message.sent_ns, *planned)
            found.append(Lesson(stop.value.stamp_ns, *times))
    return found


def _planned(
    planner: Recording, taught: Decoded[WeightsUpdate], segments: dict[int, int]
) -> tuple[int, int] | None:
    """Return when the first planning with some weights began, and when its segment was sent."""
    for session in planner.sessions:
        heard = False
        for deed, first, _, began, _ in session.rows.tolist():
            if deed == Deed.WEIGHTS and first >= taught.value.version:
                heard = True
            elif heard and deed == Deed.PLANNED and first in segments:
                begun = round(1e9 * number(began)) + _steady_to_system(session, segments)
                return begun, segments[first]
    return None


def _steady_to_system(session: Session, segments: dict[int, int]) -> int:
    """Return what to add to the steady clock of a planner to have that of the system [ns].

    Each segment was sent before the end of its planning was noted: the shortest such time tells.
    """
    return max(
        segments[first] - round(1e9 * number(until))
        for deed, first, _, _, until in session.rows.tolist()
        if deed == Deed.PLANNED and first in segments
    )  # fmt: skip
