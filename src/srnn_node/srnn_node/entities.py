# SPDX-License-Identifier: Apache-2.0
"""Frees what a node created while it was configured."""

from collections.abc import Iterator
from typing import Any

from rclpy.lifecycle import LifecycleNode
from rclpy.lifecycle.publisher import LifecyclePublisher


class EntityLedger:
    """Knows which entities a node was born with, and destroys those that came later."""

    def __init__(self, node: LifecycleNode) -> None:
        """Take the present entities of `node` as those to keep."""
        self._node = node
        self._kept = [entity for _, entity in self._entities()]

    def destroy_later_ones(self) -> None:
        """Destroy every publisher, subscription, client, service and timer that is new."""
        for destroy, entity in list(self._entities()):
            if not any(entity is kept for kept in self._kept):
                destroy(entity)

    def _entities(self) -> Iterator[tuple[Any, Any]]:
        node = self._node
        for publisher in node.publishers:
            managed = isinstance(publisher, LifecyclePublisher)
            destroy = node.destroy_lifecycle_publisher if managed else node.destroy_publisher
            yield destroy, publisher
        for kind in ('subscription', 'client', 'service', 'timer'):
            destroy = getattr(node, f'destroy_{kind}')
            for entity in getattr(node, f'{kind}s'):
                yield destroy, entity
