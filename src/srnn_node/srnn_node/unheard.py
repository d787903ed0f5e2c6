# SPDX-License-Identifier: Apache-2.0
"""Says which topics an active node listens to in vain."""

from rclpy.node import Node
from rclpy.subscription import Subscription

from srnn_msgs_py.topics import NODES, Topic

PERIOD_S = 1.0

PATIENCE = 3
"""A topic is missed after so many looks in a row: discovery may take a few seconds."""


class Unheard:
    """Looks for the publishers of what a node listens to, and logs when they come and go."""

    def __init__(self, node: Node) -> None:
        """Expect nothing yet."""
        self._log = node.get_logger()
        self._expected: list[tuple[Topic, Subscription]] = []
        self._looks = 0
        self._missed = ''
        self._timer = node.create_timer(PERIOD_S, self._look, autostart=False)

    def expect(self, row: Topic, subscription: Subscription) -> None:
        """Miss this topic when none of the nodes that should publish it does."""
        if set(row.publishers) & set(NODES):
            self._expected.append((row, subscription))

    def begin(self) -> None:
        """Look from now on."""
        self._looks = 0
        self._missed = ''
        self._timer.reset()

    def end(self) -> None:
        """Look no longer."""
        self._timer.cancel()

    def forget(self) -> None:
        """Expect nothing any more; the subscriptions are destroyed."""
        self._expected.clear()

    def _look(self) -> None:
        missing = self._words()
        self._looks = self._looks + 1 if missing else 0
        if missing and self._looks >= PATIENCE and missing != self._missed:
            self._missed = missing
            self._log.warning(f'nobody publishes {missing}')
        elif not missing and self._missed:
            self._missed = ''
            self._log.info('every topic that it listens to has a publisher')

    def _words(self) -> str:
        """Return the full names of the topics and who should publish them, empty for none."""
        topics: dict[str, list[str]] = {}
        for row, subscription in self._expected:
            if not subscription.get_publisher_count():
                topics.setdefault(' or '.join(row.publishers), []).append(subscription.topic_name)
        return '; '.join(f'{", ".join(names)} ({who})' for who, names in topics.items())
