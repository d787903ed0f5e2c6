# SPDX-License-Identifier: Apache-2.0
"""A process that tells, one JSON object per line, what it hears of the graph; for fault tests."""

import json
import sys
import time
from typing import Any

import numpy as np
import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.node import Node

from srnn_msgs_py.ros import pose, result, segment, weights
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic


def _segment(msg: Any) -> dict[str, Any]:
    value = segment.from_msg(msg)
    return {'stamp': value.stamp_ns, 'positions': np.asarray(value.positions).tolist()}


def _result(msg: Any) -> dict[str, Any]:
    value = result.from_msg(msg)
    return {'stamp': value.stamp_ns, 'code': value.code.name, 'reason': value.reason}


def _pose(msg: Any) -> dict[str, Any]:
    value = pose.from_msg(msg)
    return {'stamp': value.stamp_ns, 'tip': value.position.tolist()}


def _weights(msg: Any) -> dict[str, Any]:
    return {'version': weights.from_msg(msg).version}


def _health(msg: Any) -> dict[str, Any]:
    (status,) = msg.status
    return {
        'node': status.name.rpartition('/')[2],
        'message': status.message,
        'values': {item.key: item.value for item in status.values},
    }


def _count(_: Any) -> dict[str, Any]:
    return {}


READERS = {
    'segment': _segment,
    'segment_result': _result,
    'current_pose': _pose,
    'weights': _weights,
    '/diagnostics': _health,
    'forward_position_controller/commands': _count,
}


def tap() -> None:
    """Listen until the process is killed; names of nodes and topics are told as they change."""
    rclpy.init()
    node = Node('tap', enable_rosout=False, start_parameter_services=False)

    def tell(**content: Any) -> None:
        print(json.dumps({'t': time.monotonic(), **content}), flush=True)

    for name, read in READERS.items():
        row = topic(name)
        node.create_subscription(
            message_type(row.type_name), row.name,
            lambda msg, name=name, read=read: tell(topic=name, **read(msg)), profile(row.qos),
        )  # fmt: skip
    executor = EventsExecutor()
    executor.add_node(node)
    seen: list[str] = []
    while True:
        executor.spin_once(timeout_sec=0.05)
        names = sorted(node.get_node_names())
        if names != seen:
            seen = names
            tell(topic='', nodes=names)


if __name__ == '__main__':
    try:
        tap()
    except KeyboardInterrupt:
        sys.exit(0)
