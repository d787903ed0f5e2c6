# SPDX-License-Identifier: Apache-2.0
"""Notices messages that were sent and did not arrive, by the numbers of their senders."""

SENDERS = 16
"""Senders, one after the other, that are remembered."""


class SequenceGaps:
    """The numbers of the messages of one topic that has one sender at a time.

    A sender counts from 1. Of the first one a later number may be heard first, if it was there
    before; of its successors everything is to be heard.

    Attributes:
        lost: messages that were sent and did not arrive.

    """

    def __init__(self) -> None:
        """Hear nobody yet."""
        self.lost = 0
        self._next: list[int] = []

    def take(self, number: int) -> None:
        """Take in the number of a message that has arrived."""
        for index, expected in enumerate(self._next):
            if number == expected:
                self._next[index] += 1
                return
        before = [expected for expected in self._next if expected < number]
        if number == 1 or not before:
            # A sender that was not known.
            self.lost += number - 1 if self._next else 0
            self._next = [number + 1, *self._next[: SENDERS - 1]]
            return
        nearest = max(before)
        self.lost += number - nearest
        self._next[self._next.index(nearest)] = number + 1
