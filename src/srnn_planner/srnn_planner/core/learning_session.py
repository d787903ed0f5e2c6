# SPDX-License-Identifier: Apache-2.0
"""All that decides in an adapter, fed by whoever hears: a node, or a replay."""

from dataclasses import dataclass

import numpy as np

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.journal import Deed, Note, unnoted
from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core.adapter import Learner, Lesson
from srnn_planner.core.learned_model import LearnedModel
from srnn_planner.core.pairing import Pairing
from srnn_planner.core.parameters import ModelParameters


@dataclass(frozen=True, eq=False)
class Learned:
    """What came of a segment and its execution."""

    plan: Segment
    path: ExecutedPath
    lesson: Lesson


@dataclass(frozen=True, eq=False)
class WentBack:
    """What was done about dead weights.

    Attributes:
        left: the weights that were left; None if those in use only got a higher version.
        words: what was done, and why.

    """

    left: WeightsUpdate | None
    words: str


class LearningSession:
    """Pairs segments with their executions and learns from each pair; notes what it acts on.

    Attributes:
        learner: adapts the weights.
        model: the weights, version by version.
        active: whether it learns; else pairs are made and forgotten.
        went_back: what was done about dead weights since the last update, empty for nothing.

    """

    def __init__(
        self, model: ModelParameters, seed: int, initial: WeightsUpdate | None = None,
        note: Note = unnoted,
    ) -> None:
        """Begin with the prior weights, or with others.

        Args:
            model: the network, its workspace and how it learns.
            seed: of its random numbers.
            initial: weights to begin with, None for the prior.
            note: keeps the journal.

        Raises:
            WeightsError: those do not fit the network.

        """
        self.learner = Learner(model, np.random.default_rng([seed, 1]))
        self.model = LearnedModel(self.learner, initial)
        self.active = False
        self.went_back = ''
        self._note = note
        self._pairing = Pairing()

    def begin(self) -> None:
        """Learn from now on."""
        self._note(Deed.ACTIVATED)
        self.active = True

    def end(self) -> None:
        """Learn no more."""
        self._note(Deed.DEACTIVATED)
        self.active = False

    def segment(self, plan: Segment, now_ns: int) -> Learned | None:
        """Take in a plan; return what was learned if its execution is known.

        Raises:
            PairingError: the two do not belong together; nothing has changed.

        """
        self._note(Deed.PLAN, plan.stamp_ns)
        return self._learn(self._pairing.segment(plan), now_ns)

    def executed(self, path: ExecutedPath, now_ns: int) -> Learned | None:
        """Take in an execution; return what was learned if its plan is known.

        Raises:
            PairingError: the two do not belong together; nothing has changed.

        """
        self._note(Deed.EXECUTED, path.stamp_ns)
        return self._learn(self._pairing.executed(path), now_ns)

    def acknowledgement(self, learned: Learned, update_ms: float) -> Dissonance:
        """Return what the planner is told of a lesson, which took so long [ms]."""
        version = self.model.weights.version
        return learned.lesson.told(
            learned.plan.stamp_ns, self.learner.signal, version, update_ms
        )

    def shared(self, stamp_ns: int) -> WeightsUpdate:
        """Return the weights for the planner, learned from segment `stamp_ns`, 0 for none."""
        return WeightsUpdate(self.model.weights.version, stamp_ns, self.learner.synapses.learned)

    def refused(self, refusal: WeightsRefusal, now_ns: int) -> WentBack | None:
        """Go back to earlier weights, so that learning goes on from there too.

        Returns:
            None if there was no need.

        """
        self._note(Deed.REFUSED, refusal.refused_version, refusal.good_version)
        left = self.model.leave(refusal, now_ns)
        if left is not None:
            done = f'left weights version {left.version} for earlier ones'
        elif self.model.catch_up(refusal, now_ns):
            done = 'went on with the same weights'
        else:
            return None
        version = self.model.weights.version
        self.went_back = f'{done}, now version {version}: {refusal.reason}'
        return WentBack(left, self.went_back)

    def _learn(self, pair: tuple[Segment, ExecutedPath] | None, now_ns: int) -> Learned | None:
        if pair is None or not self.active:
            return None
        lesson = self.model.learn(*pair, now_ns)
        if lesson is None:
            return None
        if lesson.updated:
            self.went_back = ''
        return Learned(*pair, lesson)
