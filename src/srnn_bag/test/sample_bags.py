# SPDX-License-Identifier: Apache-2.0
"""Bags of real messages, for the tests."""

from pathlib import Path

import numpy as np
from rosbags.typesys import Stores, get_typestore

from srnn_bag import BagWriter, Message
from srnn_msgs_py.qos import LATCHED, MOTION

STORE = get_typestore(Stores.ROS2_JAZZY)
ARRAY = 'std_msgs/msg/Float64MultiArray'
POINT = 'geometry_msgs/msg/PointStamped'
TOPICS = {'/commands': ARRAY, '/left/point': POINT}
BEGIN_NS = 1_700_000_000_000_000_000
STEP_NS = 4_000_000


def sample(topic: str, number: int) -> Message:
    """Return the n-th message of a topic, different from all others."""
    received_ns = BEGIN_NS + number * STEP_NS
    return Message(topic, received_ns, received_ns - 1000, number + 1, content(topic, number))


def content(topic: str, number: int) -> bytes:
    """Return the n-th message of a topic in CDR."""
    types = STORE.types
    if TOPICS[topic] == ARRAY:
        layout = types['std_msgs/msg/MultiArrayLayout'](dim=[], data_offset=0)
        value = types[ARRAY](layout=layout, data=np.arange(7.0) + number)
    else:
        stamp = types['builtin_interfaces/msg/Time'](sec=number, nanosec=7)
        header = types['std_msgs/msg/Header'](stamp=stamp, frame_id='srnn_workspace')
        point = types['geometry_msgs/msg/Point'](x=float(number), y=-1.0, z=0.5)
        value = types[POINT](header=header, point=point)
    return bytes(STORE.serialize_cdr(value, TOPICS[topic]))


def samples(count: int) -> list[Message]:
    """Return messages of all topics in turn."""
    names = list(TOPICS)
    return [sample(names[number % len(names)], number) for number in range(count)]


def begin(directory: Path) -> BagWriter:
    """Begin a bag with the topics of the samples and one attachment."""
    writer = BagWriter(directory)
    writer.attach('scene.yaml', 'application/yaml', b'name: sample\n', BEGIN_NS)
    for topic, type_name in TOPICS.items():
        writer.add_topic(topic, type_name, MOTION if type_name == ARRAY else LATCHED)
    return writer


def write(directory: Path, messages: list[Message], flush_every: int = 10) -> Path:
    """Write a whole bag."""
    with begin(directory) as writer:
        for number, message in enumerate(messages):
            put(writer, message)
            if number % flush_every == 0:
                writer.flush()
    return directory


def put(writer: BagWriter, message: Message) -> None:
    """Write one message."""
    topic, received_ns, sent_ns, sequence, data = message
    writer.write(topic, data, received_ns, sent_ns, sequence)
