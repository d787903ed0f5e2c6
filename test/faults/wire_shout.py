# SPDX-License-Identifier: Apache-2.0
"""A process that publishes segments from one place again and again; for fault tests."""

import sys
import time

import rclpy
from rclpy.node import Node
from segments import line

from srnn_msgs_py.ros import segment
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic

PERIOD_S = 0.2
LENGTH = 0.05
"""Of the segments [m]."""


def shout(x: float, y: float) -> None:
    """Publish segments that begin at a place [m], until the process is killed."""
    rclpy.init()
    node = Node('shout', enable_rosout=False, start_parameter_services=False)
    row = topic('segment')
    publisher = node.create_publisher(message_type(row.type_name), row.name, profile(row.qos))
    print('shouting', flush=True)
    while True:
        stamp = node.get_clock().now().nanoseconds
        publisher.publish(segment.to_msg(line((x, y), (x + LENGTH, y), 0.1, stamp)))
        time.sleep(PERIOD_S)


if __name__ == '__main__':
    shout(float(sys.argv[1]), float(sys.argv[2]))
