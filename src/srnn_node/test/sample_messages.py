# SPDX-License-Identifier: Apache-2.0
"""One message of every topic that is sealed, and every bit of it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
import struct
from typing import Any

import numpy as np
from rclpy.serialization import deserialize_message, serialize_message

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import (
    commands,
    dissonance,
    executed,
    joints,
    pose,
    refusal,
    result,
    segment,
    weights,
)
from srnn_msgs_py.segment import ExecutedPath, Segment
from srnn_msgs_py.tip import TipPosition
from srnn_msgs_py.topics import TOPICS
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate

LEARNED = LearnedWeights(3, 1, np.arange(0, 9, 4), np.ones(3, dtype=np.float32))
OWNED = tuple(row for row in TOPICS if row.ownership)


def sample_message(name: str) -> Any:
    """Return a message as a node would send it to this topic."""
    times, points = np.linspace(0.0, 0.3, 4), np.linspace(0.01, 0.08, 8).reshape(4, 2)
    angles = np.linspace(0.1, 0.7, 7)
    measured, external = joints.to_msgs(
        JointSample(11, angles, -angles, 2.0 * angles, angles / 3.0),
        [f'joint_{n}' for n in range(7)],
    )
    rates = np.array([0.25, 0.5], dtype=np.float32)
    return {
        'segment': segment.to_msg(Segment(7, times, points, points, points)),
        'executed': executed.to_msg(ExecutedPath(7, times, points)),
        'segment_result': result.to_msg(
            SegmentResult(7, ResultCode.BLOCKED, 'touched', {'force_n': 9.5})
        ),
        'weights': weights.to_msg(WeightsUpdate(3, 7, LEARNED)),
        'dissonance': dissonance.to_msg(
            Dissonance(7, 'local', True, 3, 0.5, rates, rates, update_ms=2.5)
        ),
        'weights_refused': refusal.to_msg(WeightsRefusal(5, 3, 'no valid plan')),
        'current_pose': pose.to_msg(TipPosition(7, np.array([0.1, 0.2, 0.3]))),
        'joint_states': measured,
        'external_torque/joint_states': external,
        'forward_position_controller/commands': commands.to_msg(angles),
    }[name]


def over_the_wire(msg: Any) -> Any:
    """Return the message as a listener gets it."""
    return deserialize_message(serialize_message(msg), type(msg))


@dataclass(frozen=True)
class Leaf:
    """A field, or a part of one, and the ways in which it may be changed."""

    count: int
    change: Callable[[int], None]


def leaves(msg: Any) -> Iterator[Leaf]:
    """Yield every field: its changes turn over one bit each, or make it longer or shorter.

    Of text, only such bits that leave it text.
    """
    for name, kind in msg.get_fields_and_field_types().items():
        value = getattr(msg, name)
        if hasattr(value, 'get_fields_and_field_types'):
            yield from leaves(value)
        elif isinstance(value, list):
            yield from _listed(value)
        else:
            count, other = _others(value, kind)
            yield Leaf(count, lambda k, name=name, other=other: setattr(msg, name, other(k)))


def change(msg: Any, index: int) -> None:
    """Change a message in one of `changes(msg)` ways."""
    for leaf in leaves(msg):
        if index < leaf.count:
            leaf.change(index)
            return
        index -= leaf.count


def changes(msg: Any) -> int:
    """Return in how many ways `change` can change a message."""
    return sum(leaf.count for leaf in leaves(msg))


def _listed(values: list[Any]) -> Iterator[Leaf]:
    for index, value in enumerate(values):
        if isinstance(value, str):
            count, other = _others(value, 'string')
            yield Leaf(count, lambda k, n=index, other=other: values.__setitem__(n, other(k)))
        else:
            yield from leaves(value)
    if values:
        yield Leaf(1, lambda _: values.append(values[-1]))
        yield Leaf(1, lambda _: values.pop() and None)


def _others(value: Any, kind: str) -> tuple[int, Callable[[int], Any]]:
    """Return how many other values there are to try, and the function from number to value."""
    if isinstance(value, str):
        return 7 * len(value) + 1, lambda k: _text(value, k)
    if isinstance(value, bytes):
        return 8, lambda k: _flipped(value, k)
    if isinstance(value, (int, float)):
        form = {'double': '<d', 'int32': '<i', 'uint32': '<I'}[kind]
        raw = struct.pack(form, value)
        return 8 * len(raw), lambda k: struct.unpack(form, _flipped(raw, k))[0]
    raw = value.tobytes()
    return 8 * len(raw) + 1, lambda k: (
        type(value)(value.typecode, _flipped(raw, k)) if k < 8 * len(raw)
        else type(value)(value.typecode, [*value, 0.0])
    )  # fmt: skip


def _flipped(data: bytes, bit: int) -> bytes:
    number = int.from_bytes(data, 'little') ^ 1 << bit
    return number.to_bytes(len(data), 'little')


def _text(value: str, k: int) -> str:
    place, bit = divmod(k, 7)
    if place == len(value):
        return value + ' '
    return value[:place] + chr(ord(value[place]) ^ 1 << bit) + value[place + 1 :]
