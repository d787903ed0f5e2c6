# SPDX-License-Identifier: Apache-2.0
"""Dissonance ↔ std_msgs/Float32MultiArray: steps first, then neurons."""

import numpy as np
from std_msgs.msg import Float32MultiArray

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros.arrays import floats, require_finite
from srnn_msgs_py.ros.layout import figure, from_layout, real, to_layout, whole

_DIMS = ('steps_then_neurons',)


def to_msg(value: Dissonance) -> Float32MultiArray:
    """Return the message of the dissonance of one segment."""
    data = np.concatenate([value.global_alpha, value.neuron_peak]).astype(np.float32)
    layout = to_layout(
        {_DIMS[0]: data.size},
        {
            'steps': len(value.global_alpha),
            'segment_stamp_ns': int(value.segment_stamp_ns),
            'signal': str(value.signal),
            'updated': int(value.updated),
            'weights_version': int(value.weights_version),
            'peak': repr(float(value.peak)),
            'update_ms': repr(float(value.update_ms)),
        },
    )
    return Float32MultiArray(layout=layout, data=floats(data))


def from_msg(msg: Float32MultiArray) -> Dissonance:
    """Return the dissonance of a message, arrays read-only.

    Raises:
        MessageError: the layout is another one, a figure is missing or wrong, or a
            number is not finite.

    """
    (size,), figures = from_layout(msg.layout, len(msg.data), _DIMS)
    steps = whole(figures, 'steps')
    if steps > size:
        raise MessageError(f'steps = {steps}: must be <= {size}, the number of values')
    data = np.array(msg.data, dtype=np.float32)
    require_finite(data, 'data')
    data.setflags(write=False)
    return Dissonance(
        segment_stamp_ns=whole(figures, 'segment_stamp_ns'),
        signal=figure(figures, 'signal'),
        updated=bool(whole(figures, 'updated')),
        weights_version=whole(figures, 'weights_version'),
        peak=real(figures, 'peak'),
        global_alpha=data[:steps],
        neuron_peak=data[steps:],
        update_ms=real(figures, 'update_ms'),
    )
