# SPDX-License-Identifier: Apache-2.0
"""What an adapter has learned, version by version, with the way back."""

from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.weights import MAX_VERSION, WeightsUpdate
from srnn_planner.core.adapter import Learner, Lesson
from srnn_planner.core.checkpoint import Checkpoint
from srnn_planner.core.history import Event, History
from srnn_planner.core.lineage import Lineage
from srnn_planner.core.synapses import Synapses


class LearnedModel:
    """A learner whose weights have versions; every change gets a higher one.

    Attributes:
        learner: learns from one segment at a time.
        weights: the weights in use, with version and the segment they were learned from.
        history: what has happened to them.
        reverts: number of times that dead weights were left.

    """

    def __init__(self, learner: Learner, initial: WeightsUpdate | None = None) -> None:
        """Begin with the prior, or with weights from elsewhere.

        Raises:
            WeightsError: the weights do not fit the network.

        """
        self.learner = learner
        self.weights = WeightsUpdate(0, 0, learner.synapses.learned)
        self.history = History()
        self.reverts = 0
        self._lineage = Lineage(learner.synapses.learned)
        if initial is not None:
            learner.use_weights(initial.learned)
            self._take(max(1, initial.version), 0)
        self._initial = self.weights

    def learn(self, plan: Segment, path: ExecutedPath, now_ns: int) -> Lesson | None:
        """Learn from a segment and its execution; None if that was done before.

        Raises:
            PairingError: the two do not belong together; nothing has changed.

        """
        if self.history.learned_from(plan.stamp_ns):
            return None
        lesson = self.learner.learn(plan.positions, path.positions)
        if lesson.updated:
            self._take(self.weights.version + 1, plan.stamp_ns)
            before = self.weights.version - 1
            self.history.add(
                Event.UPDATE, self.weights, before, now_ns,
                peak=lesson.peak, signal=self.learner.signal,
            )  # fmt: skip
        return lesson

    def load(self, weights: WeightsUpdate, now_ns: int) -> None:
        """Go on from weights of elsewhere.

        Raises:
            WeightsError: they do not fit the network; nothing has changed.

        """
        self.learner.use_weights(weights.learned)
        self._take(max(self.weights.version + 1, weights.version), 0)
        self.history.add(Event.LOAD, self.weights, weights.version, now_ns)

    def revert(self, now_ns: int) -> None:
        """Go back to where learning began."""
        self.learner.use_weights(self._initial.learned)
        self._take(self.weights.version + 1, 0)
        self.history.add(Event.REVERT, self.weights, self._initial.version, now_ns)

    def leave(self, refusal: WeightsRefusal, now_ns: int) -> WeightsUpdate | None:
        """Go back to earlier weights if those in use, or those before them, are dead.

        Returns:
            The weights that were left; None if there was no need, or nothing to go back to.

        """
        target = self._lineage.back(self.weights, refusal)
        if target is None:
            return None
        left = self.weights
        self.learner.use_weights(target.learned)
        self.weights = WeightsUpdate(left.version + 1, 0, target.learned)
        self.history.add(Event.REFUSED, self.weights, target.version, now_ns)
        self.reverts += 1
        return left

    def catch_up(self, refusal: WeightsRefusal, now_ns: int) -> bool:
        """Give the weights a higher version than dead ones that are not of this adapter.

        The planner, which had them from another or from one that has forgotten, would
        refuse every version up to there. Return whether that was needed.
        """
        before = self.weights
        if not before.version < refusal.refused_version < MAX_VERSION:
            return False
        self.weights = WeightsUpdate(refusal.refused_version + 1, 0, before.learned)
        self.history.add(Event.REFUSED, self.weights, before.version, now_ns)
        return True

    def checkpoint(self) -> Checkpoint:
        """Return all that is needed to go on from here."""
        return Checkpoint(
            weights=self.weights,
            earlier=self._lineage.earlier,
            updates=self.learner.updates,
            reverts=self.reverts,
            generator=self.learner.random_state(),
            history=self.history.records,
        )

    def restore(self, value: Checkpoint, now_ns: int) -> None:
        """Go on from a checkpoint, all or nothing.

        Raises:
            WeightsError: it is of another network, or damaged; nothing has changed.

        """
        for weights in (value.weights, *value.earlier):
            self.learner.neurons.synapses(weights.learned)
        self.learner.use_random_state(value.generator)
        self.learner.use_weights(value.weights.learned)
        self.learner.updates, self.reverts = value.updates, value.reverts
        self.weights = value.weights
        self._lineage = Lineage(Synapses(self.learner.neurons.prior).learned, value.earlier)
        self.history = History(value.history)
        self.history.add(Event.RESTART, self.weights, self.weights.version, now_ns)

    def _take(self, version: int, stamp_ns: int) -> None:
        """Give the weights that the learner has now a version."""
        self._lineage.grow(self.weights)
        self.weights = WeightsUpdate(version, stamp_ns, self.learner.synapses.learned)
