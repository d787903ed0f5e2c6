# SPDX-License-Identifier: Apache-2.0
"""Which nodes somebody has paused, as they tell it themselves."""

from collections.abc import Iterable
from functools import partial
from math import inf
import time

from lifecycle_msgs.msg import State, TransitionEvent
from rclpy.node import Node

DEPTH = 10
"""Transitions that may wait to be read."""

LAST_S = 2.0
"""A node that ends itself deactivates no longer than this before [s]."""


class PausedNodes:
    """Listens to the transitions of some nodes.

    Attributes:
        paused: names of the nodes that were deactivated and not activated since.

    """

    def __init__(self, node: Node, names: Iterable[str]) -> None:
        """Listen with `node`; nobody has said anything yet."""
        self.paused: set[str] = set()
        self._since: dict[str, float] = {}
        for name in names:
            node.create_subscription(
                TransitionEvent, f'{name}/transition_event', partial(self._on_event, name), DEPTH
            )

    def ended_itself(self, name: str) -> None:
        """Forget a pause that was but the way out of a node that has ended by itself."""
        if time.monotonic() - self._since.get(name, -inf) < LAST_S:
            self.paused.discard(name)

    def _on_event(self, name: str, event: TransitionEvent) -> None:
        # A node that is inactive because it was just configured is on its way up.
        if event.start_state.id == State.TRANSITION_STATE_DEACTIVATING:
            self.paused.add(name)
            self._since[name] = time.monotonic()
        elif event.goal_state.id == State.PRIMARY_STATE_ACTIVE:
            self.paused.discard(name)
