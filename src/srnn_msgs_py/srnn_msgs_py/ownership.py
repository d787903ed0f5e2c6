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


# A node that was killed needs more than a second to be back (docs/decisions/0010-discovery.md),
# so that none of these keeps it out. They are long for a reason: on a busy machine the one in
# charge may pause, and shall not lose its place to another that happens to send meanwhile.
STREAM = Ownership(hold=0.5)
COMMAND = Ownership(hold=0.5, always=True)
REPORT = Ownership(hold=1.0)

# Segments are as far apart as they are long. Whoever comes after a planner that was killed
# cannot begin before the arm has come to rest anyway.
MOVING = Ownership(hold=0.5, motion=True, always=True)
