# SPDX-License-Identifier: Apache-2.0
"""A middleware context of its own for every test, and bounded waits."""

from collections.abc import Callable, Iterator
import gc
import os
import time
from typing import Any

import pytest
import rclpy
from rclpy.context import Context
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

PATIENCE_S = 20.0


class Bench:
    """Nodes of one context and the executor that serves them."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.executor = EventsExecutor(context=context)
        self._nodes: list[Node] = []

    def add(self, node: Node) -> Any:
        self.executor.add_node(node)
        self._nodes.append(node)
        return node

    def client(self, name: str = 'client') -> Node:
        return self.add(rclpy.create_node(name, context=self.context))

    def spin_until(self, condition: Callable[[], Any]) -> None:
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end, 'waited in vain'
            self.executor.spin_once(timeout_sec=0.05)

    def call(self, node: Node, kind: Any, name: str, request: Any) -> Any:
        client = node.create_client(kind, name)
        self.spin_until(client.service_is_ready)
        future = client.call_async(request)
        self.spin_until(future.done)
        return future.result()

    def close(self) -> None:
        self.executor.shutdown()
        while self._nodes:
            node = self._nodes.pop()
            # An active node keeps the garbage collector out, and with it its own end.
            if getattr(node, 'active', False):
                node.trigger_deactivate()
            node.destroy_node()
        del node
        gc.collect()


@pytest.fixture
def bench() -> Iterator[Bench]:
    context = Context()
    rclpy.init(
        args=[],
        context=context,
        domain_id=int(os.environ['ROS_DOMAIN_ID']),
        signal_handler_options=SignalHandlerOptions.NO,
    )
    bench = Bench(context)
    yield bench
    bench.close()
    rclpy.shutdown(context=context)
