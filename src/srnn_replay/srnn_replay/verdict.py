# SPDX-License-Identifier: Apache-2.0
"""What a replay has found of one node."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from srnn_replay.difference import Difference, first_difference
from srnn_replay.recording import Decoded, Session


@dataclass
class Verdict:
    """How many decisions of a node were made again, and the first that came out otherwise.

    Attributes:
        node: name of the node.
        decisions: how many were compared, by kind.
        unrecorded: how many were made that the bag does not have: its recorder had stopped.
        difference: the first difference, None if there is none.
        decision: which decision that is in, in words.

    """

    node: str
    decisions: Counter[str] = field(default_factory=Counter)
    unrecorded: int = 0
    difference: Difference | None = None
    decision: str = ''

    @property
    def identical(self) -> bool:
        """Tell whether all decisions came out as they were recorded."""
        return self.difference is None

    def document(self) -> dict[str, Any]:
        """Return the verdict as plain data for JSON."""
        return {
            'node': self.node,
            'identical': self.identical,
            'decisions': dict(self.decisions),
            'unrecorded': self.unrecorded,
            'difference': None if self.difference is None else self.difference.words(),
            'decision': self.decision,
        }

    def words(self) -> str:
        """Return the verdict in one line."""
        counts = ', '.join(f'{count} {kind}' for kind, count in self.decisions.items())
        if self.difference is None:
            return f'{self.node}: {counts or "no decisions"}: identical'
        return f'{self.node}: {self.decision} differs after {counts or "nothing"}: ' + (
            self.difference.words()
        )


class Told:
    """What a node has said on one topic, one after the other.

    Attributes:
        kind: what to call it, for example ``segments``.

    """

    def __init__(
        self,
        kind: str,
        said: list[tuple[int, Any]],
        name: Callable[[Any], str],
        verdict: Verdict,
    ) -> None:
        """Compare with what was recorded.

        Args:
            kind: what to call these decisions.
            said: when [ns of system time], and what, in this order.
            name: returns what to call one of them.
            verdict: gets the counts and the first difference.

        """
        self.kind = kind
        self._said = said
        self._name = name
        self._verdict = verdict
        self._next = 0

    @property
    def next(self) -> Any:
        """Return what was recorded next, None if nothing was."""
        return self._said[self._next][1] if self._next < len(self._said) else None

    def compare(self, replayed: Any) -> bool:
        """Take in what was decided again; return whether to go on."""
        if self._next >= len(self._said):
            self._verdict.unrecorded += 1
            return True
        _, recorded = self._said[self._next]
        self._next += 1
        difference = first_difference(recorded, replayed)
        if difference is None:
            self._verdict.decisions[self.kind] += 1
            return True
        self._verdict.difference = difference
        self._verdict.decision = self._name(recorded)
        return False

    def finish(self, until_ns: int) -> bool:
        """Demand that nothing more was said before a time [ns]; return whether that holds."""
        if self._next < len(self._said):
            sent_ns, recorded = self._said[self._next]
            if sent_ns < until_ns:
                self._verdict.difference = Difference(self.kind, recorded, None)
                self._verdict.decision = self._name(recorded)
                return False
        return True


def said_in(session: Session, said: 'list[Decoded[Any]]') -> list[tuple[int, Any]]:
    """Return what was sent in the time of a process, and when [ns of system time]."""
    times = ((one.message.sent_ns, one.value) for one in said)
    return [(sent_ns, value) for sent_ns, value in times if session.has(sent_ns)]
