# SPDX-License-Identifier: Apache-2.0
"""WeightsUpdate ↔ std_msgs/Float32MultiArray with labelled dimensions."""

import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import Float32MultiArray

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros.arrays import floats, require_finite
from srnn_msgs_py.ros.layout import from_layout, to_layout, whole
from srnn_msgs_py.weights import MAX_VERSION, WeightsUpdate

_DIMS = ('presynaptic', 'postsynaptic')


def to_msg(weights: WeightsUpdate) -> Float32MultiArray:
    """Return the message of a version of the weights.

    Raises:
        MessageError: the weights are not square, not finite or not in [-1, 1], or the
            version is out of range.

    """
    _check(weights)
    layout = to_layout(
        dict(zip(_DIMS, weights.matrix.shape, strict=True)),
        {
            'version': int(weights.version),
            'segment_stamp_ns': int(weights.segment_stamp_ns),
            'crc32': weights.checksum(),
        },
    )
    return Float32MultiArray(layout=layout, data=floats(weights.matrix))


def from_msg(msg: Float32MultiArray, neurons: int | None = None) -> WeightsUpdate:
    """Return the weights of a message, read-only; all or nothing.

    Args:
        msg: message to read.
        neurons: number of neurons that the weights must be for; None for any.

    Raises:
        MessageError: the layout is another one, the weights are not square, not for this
            many neurons, not finite or not in [-1, 1], the version is out of range, or
            the checksum does not fit.

    """
    shape, figures = from_layout(msg.layout, len(msg.data), _DIMS)
    if neurons is not None and shape != (neurons, neurons):
        raise MessageError(f'weights of shape {shape}: must be ({neurons}, {neurons})')
    matrix = np.array(msg.data, dtype=np.float32).reshape(shape)
    matrix.setflags(write=False)
    weights = WeightsUpdate(
        whole(figures, 'version'), whole(figures, 'segment_stamp_ns'), matrix
    )
    _check(weights)
    expected = whole(figures, 'crc32')
    if weights.checksum() != expected:
        raise MessageError(f'crc32 = {expected}: the data give {weights.checksum()}')
    return weights


def _check(weights: WeightsUpdate) -> None:
    matrix: NDArray[np.float32] = weights.matrix
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or matrix.size == 0:
        raise MessageError(f'weights of shape {matrix.shape}: must be square and not empty')
    require_finite(matrix, 'weights')
    peak = float(np.abs(matrix).max())
    if peak > 1.0:
        raise MessageError(f'weights reach {peak:g} in size: must be in [-1, 1]')
    if not 0 <= weights.version <= MAX_VERSION:
        raise MessageError(f'version = {weights.version}: must be 0 to {MAX_VERSION}')
