# SPDX-License-Identifier: Apache-2.0
"""The decisions of the planner made again: each segment, and each refusal of weights."""

from collections.abc import Hashable, Sequence
from contextlib import suppress
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from srnn_bag import Message
from srnn_msgs_py.journal import Deed, number
from srnn_msgs_py.ros import (
    dissonance,
    executed,
    refusal,
    result,
    segment,
    waypoints,
    weights,
)
from srnn_msgs_py.segment import Segment
from srnn_planner.core.errors import SrnnError
from srnn_planner.core.planning_session import PlanningSession
from srnn_replay.difference import Difference
from srnn_replay.inputs import Inputs
from srnn_replay.joint_state_bytes import last_numbers, stamps_ns
from srnn_replay.origin import RunOrigin
from srnn_replay.recording import Recording, Session
from srnn_replay.verdict import Told, Verdict, said_in

NODE = 'planner'
POSE = 'current_pose'
TOPICS = (
    'segment', 'weights_refused', POSE, 'executed', 'segment_result', 'dissonance',
    'weights', 'waypoints',
)  # fmt: skip

POSE_NUMBERS = 7


def positions(poses: Sequence[Message]) -> dict[Hashable, NDArray[np.float64]]:
    """Return the positions (3,) [m] of poses, by their stamps [ns].

    There are too many of them to make a message of each.
    """
    data = [message.data for message in poses]
    stamps = stamps_ns(data).tolist()
    return {s: pose[:3] for s, pose in zip(stamps, last_numbers(data, POSE_NUMBERS), strict=True)}


class PlannerReplay:
    """Feeds a planner what the planner of a recording has acted on."""

    def __init__(self, origin: RunOrigin, prefix: str) -> None:
        """Read the inputs of a graph, whose names begin with `prefix`."""
        recording = Recording(origin.bag, NODE, TOPICS, prefix)
        self._origin = origin.planner()
        self._recording = recording
        neurons = self._origin.model.network.neurons
        self._poses = Inputs(NODE, POSE, positions(recording.raw(POSE)))
        self._paths = Inputs.read(recording, 'executed', executed.from_msg, lambda v: v.stamp_ns)
        self._results = Inputs.read(
            recording, 'segment_result', result.from_msg, lambda v: (v.stamp_ns, v.digest())
        )
        self._lessons = Inputs.read(
            recording, 'dissonance', dissonance.from_msg, lambda v: v.segment_stamp_ns
        )
        self._weights = Inputs.read(
            recording, 'weights', partial(weights.from_msg, neurons=neurons),
            lambda v: (v.version, v.checksum()),
        )  # fmt: skip
        self._tours = Inputs.read(recording, 'waypoints', waypoints.from_msg, lambda v: v.stamp_ns)
        self._verdict = Verdict(NODE)

    def run(self) -> Verdict:
        """Make all decisions again, until one differs."""
        for session in self._recording.sessions:
            self._begin(session)
            if not all(self._act(Deed(int(row[0])), row) for row in session.rows):
                break
        return self._verdict

    def _begin(self, session: Session) -> None:
        self._session = PlanningSession(self._origin)
        self._segments = Told(
            'segments', said_in(session, self._recording.decoded('segment', segment.from_msg)),
            lambda v: f'segment {v.stamp_ns}', self._verdict,
        )  # fmt: skip
        self._refusals = Told(
            'refusals of weights',
            said_in(session, self._recording.decoded('weights_refused', refusal.from_msg)),
            lambda v: f'refusal of weights {v.refused_version}', self._verdict,
        )  # fmt: skip

    def _act(self, deed: Deed, row: NDArray[np.int64]) -> bool:
        """Do again what one row tells; return whether to go on."""
        _, first, second, time, until = (int(value) for value in row)
        session = self._session
        # What the planner has refused it refuses again.
        with suppress(SrnnError):
            match deed:
                case Deed.ACTIVATED | Deed.BLIND:
                    session.sequencer.forget_motion()
                case Deed.POSED:
                    session.pose(self._poses[first])
                case Deed.EXECUTED:
                    session.executed(self._paths[first])
                case Deed.ENDED:
                    session.result(self._results[first, second], number(time))
                case Deed.LEARNED:
                    session.lesson(self._lessons[first])
                case Deed.WEIGHTS:
                    session.weights(self._weights[first, second])
                case Deed.TOUR:
                    session.tour(self._tours[first])
                case Deed.PLANNED:
                    return self._plan(first, number(time), number(until))
                case Deed.PLANNED_IN_VAIN:
                    return self._plan(None, number(time), number(until))
        return True

    def _plan(self, stamp_ns: int | None, began: float, until: float) -> bool:
        """Plan again; `stamp_ns` is None if there was no valid movement, 0 if nothing was due."""
        session = self._session
        request = session.sequencer.request(began)
        if (request is None) != (stamp_ns == 0):
            return self._differs('whether a segment is due', stamp_ns != 0, request is not None)
        if request is None:
            return True
        trajectory = session.watched.plan(request)
        if (trajectory is None) != (stamp_ns is None):
            return self._differs('whether a movement is valid', stamp_ns, trajectory is not None)
        if trajectory is None or stamp_ns is None:
            session.sequencer.failed(until - began, until)
            self._verdict.decisions['invalid plans'] += 1
        else:
            session.sequencer.sent(stamp_ns, trajectory, until - began, until)
            knots: Any = Segment(stamp_ns, **vars(trajectory))
            if not self._segments.compare(segment.from_msg(segment.to_msg(knots))):
                return False
        told, session.watched.refusal = session.watched.refusal, None
        return told is None or self._refusals.compare(refusal.from_msg(refusal.to_msg(told)))

    def _differs(self, what: str, recorded: Any, replayed: Any) -> bool:
        self._verdict.difference = Difference(what, recorded, replayed)
        self._verdict.decision = f'the plan after {self._verdict.decisions["segments"]} segments'
        return False
