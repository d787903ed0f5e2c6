# SPDX-License-Identifier: Apache-2.0
"""A publisher whose messages tell who sent them."""

import time
from typing import Any

from rclpy.lifecycle.publisher import LifecyclePublisher

from srnn_node.outlet import Outlet


class MarkedPublisher(LifecyclePublisher):  # type: ignore[misc]  # rclpy is not typed
    """Marks every message while it is sent; the message itself stays as it was."""

    _outlet: Outlet
    _kept: Any = None
    _keeps = False
    _matched = 0

    def use(self, outlet: Outlet, keep: bool) -> None:
        """Mark by `outlet`; with `keep`, the last message is there to be renewed."""
        self._outlet = outlet
        self._keeps = keep

    def publish(self, msg: Any) -> None:
        """Publish a message if the publisher is enabled."""
        if not self.is_activated:
            return
        if self._keeps:
            self._kept = msg
        self._outlet.mark(msg, time.time_ns())
        try:
            super().publish(msg)
        finally:
            self._outlet.unmark(msg)

    def renew(self, change: Any) -> None:
        """Send the last message anew, signed now, when a subscriber has come.

        The middleware gives a late subscriber the message as it was signed long ago,
        which nobody believes who has not heard of the sender before.
        """
        # What the status calls the change is at times 0 for a subscriber that has come.
        came, self._matched = change.total_count > self._matched, change.total_count
        if came and self._kept is not None:
            self.publish(self._kept)
