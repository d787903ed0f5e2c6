# SPDX-License-Identifier: Apache-2.0
"""The versions that came before the weights in use, for when these turn out to be dead."""

from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate

KEPT = 8
"""Earlier versions kept; before the oldest there is still the prior."""


class Lineage:
    """A stack of earlier versions; going back takes away whatever lies above.

    Attributes:
        earlier: the versions before the one in use, oldest first.

    """

    def __init__(
        self, nothing: LearnedWeights, earlier: tuple[WeightsUpdate, ...] = ()
    ) -> None:
        """Begin with the prior, beside which nothing is learned, and what is known of the past."""
        self._prior = WeightsUpdate(0, 0, nothing)
        self.earlier = earlier[-KEPT:]

    def grow(self, replaced: WeightsUpdate) -> None:
        """Take in the version that new weights take the place of."""
        self.earlier = (*self.earlier, replaced)[-KEPT:]

    def back(self, in_use: WeightsUpdate, refusal: WeightsRefusal) -> WeightsUpdate | None:
        """Return the weights to go back to; they and all later ones leave the stack.

        The newest that are older than the refused ones and, where the planner knows of
        good ones, no newer than these. The prior after all others.

        Args:
            in_use: the weights of the moment.
            refusal: what the planner says of them or of those they were learned from.

        Returns:
            None if the refused weights have been left already, or there is nothing older.

        """
        refused, good = refusal.refused_version, refusal.good_version
        if refused not in {weights.version for weights in (*self.earlier, in_use)}:
            return None
        older = [
            weights for weights in self.earlier
            if weights.version < refused and not 0 < good < weights.version
        ]  # fmt: skip
        if not older and in_use.learned.same_as(self._prior.learned):
            return None
        self.earlier = tuple(older[:-1])
        return older[-1] if older else self._prior
