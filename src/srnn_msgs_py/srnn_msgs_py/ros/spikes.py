# SPDX-License-Identifier: Apache-2.0
"""Imagined spikes ↔ std_msgs/UInt8MultiArray: steps, neurons."""

from array import array

import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import UInt8MultiArray

from srnn_msgs_py.imagination import Imagination
from srnn_msgs_py.ros.layout import from_layout, to_layout

_DIMS = ('step', 'neuron')


def to_msg(value: Imagination) -> UInt8MultiArray:
    """Return the message of the spikes."""
    layout = to_layout(
        dict(zip(_DIMS, value.spikes.shape, strict=True)),
        {'segment_stamp_ns': int(value.segment_stamp_ns), 'samples': len(value.samples)},
    )
    return UInt8MultiArray(layout=layout, data=array('B', value.spikes.tobytes()))


def from_msg(msg: UInt8MultiArray) -> NDArray[np.uint8]:
    """Return how many samples of each neuron spiked in each step (T, K).

    Raises:
        MessageError: the layout is another one.

    """
    shape, _ = from_layout(msg.layout, len(msg.data), _DIMS)
    return np.array(msg.data, dtype=np.uint8).reshape(shape)
