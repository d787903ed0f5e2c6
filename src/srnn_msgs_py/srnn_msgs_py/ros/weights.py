# SPDX-License-Identifier: Apache-2.0
"""WeightsUpdate ↔ std_msgs/Float32MultiArray: a row for each synapse that was learned."""

import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import Float32MultiArray

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.ros.arrays import floats
from srnn_msgs_py.ros.layout import from_layout, to_layout, whole
from srnn_msgs_py.weights import MAX_NEURONS, MAX_VERSION, LearnedWeights, WeightsUpdate

_DIMS = ('synapse', 'presynaptic, postsynaptic, weight')
_COLUMNS = 3


def to_msg(weights: WeightsUpdate) -> Float32MultiArray:
    """Return the message of a version of the weights.

    Raises:
        MessageError: see `LearnedWeights.objection`, or the version is out of range.

    """
    _check(weights)
    learned = weights.learned
    rows = np.empty((len(learned.synapses), _COLUMNS), dtype=np.float32)
    rows[:, 0], rows[:, 1] = np.divmod(learned.synapses, learned.neurons)
    rows[:, 2] = learned.values
    layout = to_layout(
        dict(zip(_DIMS, rows.shape, strict=True)),
        {
            'neurons': int(learned.neurons),
            'prior_crc32': int(learned.prior),
            'version': int(weights.version),
            'segment_stamp_ns': int(weights.segment_stamp_ns),
            'crc32': weights.checksum(),
        },
    )
    return Float32MultiArray(layout=layout, data=floats(rows))


def from_msg(msg: Float32MultiArray, neurons: int | None = None) -> WeightsUpdate:
    """Return the weights of a message, read-only; all or nothing.

    Args:
        msg: message to read.
        neurons: number of neurons that the weights must be for; None for any.

    Raises:
        MessageError: the layout is another one, the weights are not for this many neurons,
            a row names no synapse or comes out of order, a weight is not finite or not in
            [-1, 1], the version is out of range, or the checksum does not fit.

    """
    shape, figures = from_layout(msg.layout, len(msg.data), _DIMS)
    if shape[1] != _COLUMNS:
        raise MessageError(f'rows of {shape[1]} values: must be {_COLUMNS}')
    count = whole(figures, 'neurons')
    if not 1 <= count <= MAX_NEURONS:
        raise MessageError(f'neurons = {count}: must be 1 to {MAX_NEURONS}')
    if neurons is not None and count != neurons:
        raise MessageError(f'weights of {count} neurons: must be of {neurons}')
    rows = np.array(msg.data, dtype=np.float32).reshape(shape)
    synapses = _synapses(rows[:, :2], count)
    values = rows[:, 2].copy()
    for part in (synapses, values):
        part.setflags(write=False)
    learned = LearnedWeights(count, whole(figures, 'prior_crc32'), synapses, values)
    weights = WeightsUpdate(
        whole(figures, 'version'), whole(figures, 'segment_stamp_ns'), learned
    )
    _check(weights)
    expected = whole(figures, 'crc32')
    if weights.checksum() != expected:
        raise MessageError(f'crc32 = {expected}: the data give {weights.checksum()}')
    return weights


def _synapses(pairs: NDArray[np.float32], neurons: int) -> NDArray[np.int64]:
    """Return the synapses of pairs (n, 2) of presynaptic and postsynaptic neuron."""
    # A number that is not finite compares as false; of zeros only the plain one is sent.
    among = (pairs >= 0.0) & (pairs < neurons) & (pairs == np.rint(pairs)) & ~np.signbit(pairs)
    if not among.all():
        row, column = np.argwhere(~among)[0]
        raise MessageError(
            f'neuron {pairs[row, column]:g} in row {row}: must be one of 0 to {neurons - 1}'
        )
    pre, post = pairs.astype(np.int64).T
    return np.asarray(pre * neurons + post)


def _check(weights: WeightsUpdate) -> None:
    objection = weights.learned.objection()
    if objection:
        raise MessageError(objection)
    if not 0 <= weights.version <= MAX_VERSION:
        raise MessageError(f'version = {weights.version}: must be 0 to {MAX_VERSION}')
