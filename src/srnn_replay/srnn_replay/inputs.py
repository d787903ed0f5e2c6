# SPDX-License-Identifier: Apache-2.0
"""What a node has heard, found by what names it in the journal."""

from collections.abc import Callable, Hashable, Mapping
from typing import Any, Generic, TypeVar

from srnn_replay.errors import NotReplayableError
from srnn_replay.recording import Recording

V = TypeVar('V')


class Inputs(Generic[V]):
    """The values of one topic."""

    def __init__(self, node: str, topic: str, values: Mapping[Hashable, V]) -> None:
        """Take what a node has heard on a topic of the topic table, by what names it."""
        self._node, self._topic, self._values = node, topic, values

    @classmethod
    def read(
        cls,
        recording: Recording,
        topic: str,
        convert: Callable[[Any], V],
        name: Callable[[V], Hashable],
    ) -> 'Inputs[V]':
        """Read a topic.

        Args:
            recording: where from.
            topic: its name in the topic table.
            convert: turns a message into a value.
            name: returns what names a value in the journal.

        """
        values = {name(d.value): d.value for d in recording.decoded(topic, convert)}
        return cls(recording.node, topic, values)

    def __getitem__(self, name: Hashable) -> V:
        try:
            return self._values[name]
        except KeyError:
            raise NotReplayableError(
                f'{self._node}: the bag lacks {self._topic} {name}, which it has acted on'
            ) from None
