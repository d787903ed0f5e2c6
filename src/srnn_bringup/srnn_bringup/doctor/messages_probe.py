# SPDX-License-Identifier: Apache-2.0
"""Speaks or listens: python -m srnn_bringup.doctor.messages_probe speak|listen TOPIC.

The listener ends with a line of JSON: after how many seconds the first message came, null for
none; over which middleware; and which nodes of others it has seen.
"""

from collections.abc import Sequence
import json
import sys
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

from srnn_bringup.doctor.messages import ARRIVE_S

PERIOD_S = 0.1
LOOK_S = 1.5
"""By then every node that is there has announced itself [s]."""

SPEAK_S = 90.0
"""A speaker that nobody ends falls silent [s]."""


def main(arguments: Sequence[str]) -> int:
    """Speak or listen, and return the exit code."""
    role, topic = arguments
    rclpy.init()
    node = Node(f'{topic}_{role}', enable_rosout=False, start_parameter_services=False)
    try:
        return _speak(node, topic) if role == 'speak' else _listen(node, topic)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _speak(node: Node, topic: str) -> int:
    publisher = node.create_publisher(Empty, topic, 1)
    end = time.monotonic() + SPEAK_S
    while time.monotonic() < end:
        publisher.publish(Empty())
        time.sleep(PERIOD_S)
    return 0


def _listen(node: Node, topic: str) -> int:
    arrivals: list[float] = []
    node.create_subscription(Empty, topic, lambda _: arrivals.append(time.monotonic()), 1)
    began = time.monotonic()
    while not arrivals and time.monotonic() < began + ARRIVE_S:
        rclpy.spin_once(node, timeout_sec=PERIOD_S)
    time.sleep(LOOK_S)
    others = sorted(name for name in node.get_node_names() if not name.startswith(topic))
    found = {
        'seconds': arrivals[0] - began if arrivals else None,
        'middleware': rclpy.get_rmw_implementation_identifier(),
        'others': others,
    }
    print(json.dumps(found))
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
