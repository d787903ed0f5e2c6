# SPDX-License-Identifier: Apache-2.0
"""How long a sender stays in charge of a topic, by name."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Ownership:
    """What listeners of a topic know about its sender.

    Attributes:
        hold: who was heard last stays in charge for this long [s].
        motion: and until the motion is over that it asked for last.
        always: messages are marked, and their sender is held to it, even without a key.

    """

    hold: float
    motion: bool = False
    always: bool = False

    def words(self) -> str:
        """Return when messages are marked, as the README prints it."""
        return 'always' if self.always else 'with a key'


HOLD_S = 0.5
"""Shorter than any start of a node, so that whoever is started anew is not kept out; long enough
for the one in charge to pause on a busy machine without losing its place."""

KEYED = Ownership(HOLD_S)
COMMAND = Ownership(HOLD_S, always=True)

# Segments are as far apart as they are long. Whoever comes after a planner that was killed
# cannot begin before the arm has come to rest anyway.
MOVING = Ownership(HOLD_S, motion=True, always=True)
