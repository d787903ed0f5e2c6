# SPDX-License-Identifier: Apache-2.0
"""Notices weights with which nothing can be planned, and knows those that were good."""

from collections import deque

from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_planner.core.errors import WeightsError

KEPT = 8
"""Good versions kept; before the oldest there is still the prior."""


class ModelWatch:
    """Decides which weights a planner uses; a state machine fed with what became of its plans.

    Weights are good once a valid plan was made with them. After too many invalid plans in
    a row older good ones are tried, the newest first, the prior last. Only when one of
    them gives a valid plan are the newer ones refused for good: where no weights at all
    give one it is not the weights' fault, and the newest have their turn again.

    Attributes:
        in_use: the weights to plan with.
        refusals: number of times that weights were refused for being dead.

    """

    def __init__(self, nothing: LearnedWeights, dead_after: int) -> None:
        """Begin with the prior, version 0, beside which nothing is learned.

        So many invalid plans in a row are too many.
        """
        self.in_use = self._newest = self._prior = WeightsUpdate(0, 0, nothing)
        self.refusals = 0
        self._dead_after = dead_after
        self._good: deque[WeightsUpdate] = deque(maxlen=KEPT)
        self._dead: list[WeightsUpdate] = []
        self._tries = 0
        self._hopeless = False

    @property
    def newest_version(self) -> int:
        """Version of the newest weights that were taken; those in use may be older."""
        return self._newest.version

    @property
    def trouble(self) -> str:
        """What is wrong, in words; empty while the newest weights are in use."""
        tries = f'no valid plan in {self._dead_after} tries'
        if self._hopeless:
            return f'{tries} with any weights, those of the prior included'
        if self._dead:
            return f'{tries} with weights version {self._dead[0].version}: trying older ones'
        if self.in_use is not self._newest:
            return (
                f'weights version {self._newest.version} are dead: planning with those of '
                f'version {self.in_use.version} until newer ones come'
            )
        return ''

    def check(self, weights: WeightsUpdate) -> None:
        """Refuse weights that must not take the place of those in use.

        Raises:
            WeightsError: an older version, the same one with another content, or one that
                is dead.

        """
        newest = self._newest
        if weights.version > newest.version:
            return
        what = f'weights version {weights.version} refused: '
        if weights.version < newest.version:
            # Of an adapter that has forgotten: what was learned is not given up for it.
            raise WeightsError(f'{what}version {newest.version} is in use')
        if not weights.learned.same_as(newest.learned):
            raise WeightsError(f'{what}the same version with other content is in use')
        if self.in_use is not newest:
            raise WeightsError(f'{what}no valid plan was found with it')

    def take(self, weights: WeightsUpdate) -> None:
        """Use weights that `check` lets pass."""
        if weights.version == self._newest.version:
            return
        if weights.learned.same_as(self.in_use.learned):
            self._rename(weights)
        else:
            self._tries = 0
        self.in_use = self._newest = weights
        self._dead, self._hopeless = [], False

    def planned(self) -> WeightsRefusal | None:
        """Take in a valid plan; return what the adapter must be told, if anything."""
        self._tries = 0
        self._hopeless = False
        if self._dead:
            return self._refuse(self._dead)
        if self.in_use is not self._prior and self._position() is None:
            self._good.append(self.in_use)
        return None

    def failed(self) -> bool:
        """Take in an invalid plan; return whether other weights are in use from now on."""
        self._tries += 1
        if self._tries < self._dead_after:
            return False
        self._tries = 0
        before = self.in_use
        self._dead.append(before)
        if before is self._prior:
            self.in_use, self._dead, self._hopeless = self._dead[0], [], True
        else:
            index = self._position()
            older = list(self._good)[:index]
            self.in_use = older[-1] if older else self._prior
        return self.in_use is not before

    def _refuse(self, dead: list[WeightsUpdate]) -> WeightsRefusal:
        self._dead = []
        self._good = deque((w for w in self._good if not any(w is d for d in dead)), KEPT)
        self.refusals += 1
        versions = ', '.join(str(weights.version) for weights in dead)
        reason = f'no valid plan in {self._dead_after} tries with weights version {versions}'
        return WeightsRefusal(dead[0].version, self.in_use.version, reason)

    def _rename(self, weights: WeightsUpdate) -> None:
        """Know the weights in use by a new version: the adapter has gone back to them as well."""
        index = self._position()
        if index is not None:
            self._good[index] = weights
        elif self.in_use is self._prior:
            # Whatever was good before has been tried in vain.
            self._prior = weights
            self._good.clear()

    def _position(self) -> int | None:
        """Return where the weights in use are among the good ones, None for nowhere."""
        return next((n for n, known in enumerate(self._good) if known is self.in_use), None)
