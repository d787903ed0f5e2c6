# SPDX-License-Identifier: Apache-2.0
"""Imagined movements ↔ std_msgs/Float32MultiArray: samples, steps, axes; kept ones first."""

import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import Float32MultiArray

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.imagination import Imagination
from srnn_msgs_py.ros.arrays import floats, require_finite
from srnn_msgs_py.ros.layout import from_layout, to_layout, whole

_DIMS = ('sample', 'step', 'axis')


def to_msg(value: Imagination) -> Float32MultiArray:
    """Return the message of the movements."""
    ordered = np.concatenate([value.samples[value.kept], value.samples[~value.kept]])
    layout = to_layout(
        dict(zip(_DIMS, ordered.shape, strict=True)),
        {'segment_stamp_ns': int(value.segment_stamp_ns), 'kept': int(value.kept.sum())},
    )
    return Float32MultiArray(layout=layout, data=floats(ordered))


def from_msg(msg: Float32MultiArray) -> tuple[NDArray[np.float32], int]:
    """Return the movements (S, T, d) [m], those first that were kept, and how many these are.

    Raises:
        MessageError: the layout is another one, or a number is not finite.

    """
    shape, figures = from_layout(msg.layout, len(msg.data), _DIMS)
    kept = whole(figures, 'kept')
    if kept > shape[0]:
        raise MessageError(f'kept = {kept}: must be <= {shape[0]}, the number of samples')
    samples = np.array(msg.data, dtype=np.float32).reshape(shape)
    require_finite(samples, 'data')
    samples.setflags(write=False)
    return samples, kept
