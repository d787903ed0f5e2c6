# SPDX-License-Identifier: Apache-2.0
"""When a process that has just come is known to those who were there before."""

from rclpy.node import Node

FOUND_S = 0.5
"""By this age a newcomer has found all others [s].

They announce themselves every 0.2 s (`fastdds.xml`); the last of five was found 0.12 to 0.38 s
after the newcomer was created, when a node whose kernels are compiled is about to be ready.
"""

QUIET_S = 0.1
"""Their topics are connected when nobody new was found for this long [s]."""

LONGEST_S = 3.0
"""Where somebody comes all the time, it is not waited for longer [s]."""


class Settling:
    """Waits until no more endpoints are found; all times in seconds of one steady clock."""

    def __init__(self, created: float, now: float) -> None:
        """Begin to wait.

        Args:
            created: when the newcomer began to look for others [s].
            now: when it has connected all its topics [s].

        """
        self._created = created
        self._began = self._changed = now
        self._matched = 0

    def done(self, matched: int, now: float) -> bool:
        """Tell whether everybody has been found.

        Args:
            matched: number of endpoints found. It may shrink: of a predecessor that was
                killed some are still there.
            now: time of asking [s].

        """
        if matched > self._matched:
            self._changed = now
        self._matched = matched
        found = now - self._created >= FOUND_S and now - self._changed >= QUIET_S
        return found or now - self._began >= LONGEST_S


def matched_endpoints(node: Node) -> int:
    """Return how many endpoints of other nodes the topics of a node have found."""
    heard_by: int = sum(p.get_subscription_count() for p in node.publishers)
    hears: int = sum(s.get_publisher_count() for s in node.subscriptions)
    return heard_by + hears
