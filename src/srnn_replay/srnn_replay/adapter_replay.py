# SPDX-License-Identifier: Apache-2.0
"""The decisions of the adapter made again: each lesson, each version of the weights."""

from functools import partial

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.ros import dissonance, executed, refusal, segment, weights
from srnn_planner.core.checkpoint import Checkpoint
from srnn_planner.core.errors import PairingError
from srnn_planner.core.learning_session import Learned, LearningSession
from srnn_replay.errors import NotReplayableError
from srnn_replay.inputs import Inputs
from srnn_replay.origin import RunOrigin
from srnn_replay.recording import Recording, Session
from srnn_replay.verdict import Told, Verdict, said_in

NODE = 'adapter'
TOPICS = ('segment', 'executed', 'weights_refused', 'weights', 'dissonance')

NO_TIME = 0
"""Times are kept beside the weights only; nothing is decided by them."""


class AdapterReplay:
    """Feeds an adapter what the adapter of a recording has acted on."""

    def __init__(self, origin: RunOrigin, prefix: str) -> None:
        """Read the inputs of a graph, whose names begin with `prefix`."""
        recording = Recording(origin.bag, NODE, TOPICS, prefix)
        told = origin.adapter()
        self._told, self._start = told, origin.start_weights()
        self._recording = recording
        self._convert = partial(weights.from_msg, neurons=told.model.network.neurons)
        self._plans = Inputs.read(recording, 'segment', segment.from_msg, lambda v: v.stamp_ns)
        self._paths = Inputs.read(recording, 'executed', executed.from_msg, lambda v: v.stamp_ns)
        self._refused = Inputs.read(
            recording, 'weights_refused', refusal.from_msg,
            lambda v: (v.refused_version, v.good_version),
        )  # fmt: skip
        self._versions = Inputs.read(recording, 'weights', self._convert, lambda v: v.version)
        self._verdict = Verdict(NODE)
        self._checkpoint: Checkpoint | None = None

    def run(self) -> Verdict:
        """Make all decisions again, until one differs."""
        for session in self._recording.sessions:
            self._begin(session)
            if not all(self._act(Deed(int(row[0])), row) for row in session.rows):
                break
        return self._verdict

    def _begin(self, session: Session) -> None:
        self._session = LearningSession(self._told.model, self._told.seed, self._start)
        self._lessons = Told(
            'lessons',
            said_in(session, self._recording.decoded('dissonance', dissonance.from_msg)),
            lambda v: f'lesson of segment {v.segment_stamp_ns}', self._verdict,
        )  # fmt: skip
        self._shared = Told(
            'versions of the weights',
            said_in(session, self._recording.decoded('weights', self._convert)),
            lambda v: f'version {v.version} of the weights', self._verdict,
        )  # fmt: skip

    def _act(self, deed: Deed, row: NDArray[np.int64]) -> bool:
        """Do again what one row tells; return whether to go on."""
        first, second = int(row[1]), int(row[2])
        session, model = self._session, self._session.model
        match deed:
            case Deed.PLAN | Deed.EXECUTED:
                return self._learn(deed, first)
            case Deed.RESTORED:
                self._restore(first)
            case Deed.ACTIVATED:
                session.begin()
                return self._share(0)
            case Deed.DEACTIVATED:
                session.end()
            case Deed.REFUSED:
                refused = self._refused[first, second]
                if session.refused(refused, NO_TIME) is not None:
                    return self._keep_and_share(0)
            case Deed.LOAD:
                model.load(self._versions[first], NO_TIME)
                return self._keep_and_share(0)
            case Deed.REVERT:
                model.revert(NO_TIME)
                return self._keep_and_share(0)
        return True

    def _restore(self, version: int) -> None:
        kept = self._checkpoint
        if kept is None or kept.weights.version != version:
            raise NotReplayableError(
                f'{NODE}: it went on from version {version} of a checkpoint, which was learned '
                'before this bag'
            )
        self._session.model.restore(kept, NO_TIME)

    def _learn(self, deed: Deed, stamp_ns: int) -> bool:
        try:
            learned = (
                self._session.segment(self._plans[stamp_ns], NO_TIME)
                if deed is Deed.PLAN
                else self._session.executed(self._paths[stamp_ns], NO_TIME)
            )
        except PairingError:
            return True  # As the node: what does not fit teaches nothing.
        if learned is None:
            return True
        if learned.lesson.updated and not self._keep_and_share(learned.plan.stamp_ns):
            return False
        return self._acknowledge(learned)

    def _acknowledge(self, learned: Learned) -> bool:
        recorded = self._lessons.next
        # How long it took then is no decision.
        update_ms = recorded.update_ms if isinstance(recorded, Dissonance) else 0.0
        value = self._session.acknowledgement(learned, update_ms)
        return self._lessons.compare(dissonance.from_msg(dissonance.to_msg(value)))

    def _keep_and_share(self, stamp_ns: int) -> bool:
        self._checkpoint = self._session.model.checkpoint()
        return self._share(stamp_ns)

    def _share(self, stamp_ns: int) -> bool:
        return self._shared.compare(self._convert(weights.to_msg(self._session.shared(stamp_ns))))
