# SPDX-License-Identifier: Apache-2.0
"""All that decides in an adapter, fed by whoever hears: a node, or a replay."""

from dataclasses import dataclass

import numpy as np

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


class LearningSession:
    """Pairs segments with their executions and learns from each pair.

    Attributes:
        learner: adapts the weights.
        model: the weights, version by version.
        active: whether it learns; else pairs are made and forgotten.

    """

    def __init__(
        self, model: ModelParameters, seed: int, initial: WeightsUpdate | None = None
    ) -> None:
        """Begin with the prior weights, or with others.

        Raises:
            WeightsError: those do not fit the network.

        """
        self.learner = Learner(model, np.random.default_rng([seed, 1]))
        self.model = LearnedModel(self.learner, initial)
        self.active = False
        self._pairing = Pairing()

    def segment(self, plan: Segment, now_ns: int) -> Learned | None:
        """Take in a plan; return what was learned if its execution is known.

        Raises:
            PairingError: the two do not belong together; nothing has changed.

        """
        return self._learn(self._pairing.segment(plan), now_ns)

    def executed(self, path: ExecutedPath, now_ns: int) -> Learned | None:
        """Take in an execution; return what was learned if its plan is known.

        Raises:
            PairingError: the two do not belong together; nothing has changed.

        """
        return self._learn(self._pairing.executed(path), now_ns)

    def _learn(self, pair: tuple[Segment, ExecutedPath] | None, now_ns: int) -> Learned | None:
        if pair is None or not self.active:
            return None
        lesson = self.model.learn(*pair, now_ns)
        return None if lesson is None else Learned(*pair, lesson)
