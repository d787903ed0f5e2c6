# SPDX-License-Identifier: Apache-2.0
"""WeightsRefusal ↔ std_msgs/Int64MultiArray with the reason beside the versions."""

from array import array

from std_msgs.msg import Int64MultiArray

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.refusal import WeightsRefusal
from srnn_msgs_py.ros.layout import figure, from_layout, to_layout
from srnn_msgs_py.weights import MAX_VERSION

MAX_REASON = 300
"""Longest reason in characters."""

_DIMS = ('refused_then_good',)


def to_msg(refusal: WeightsRefusal) -> Int64MultiArray:
    """Return the message of a refusal."""
    versions = array('q', [int(refusal.refused_version), int(refusal.good_version)])
    layout = to_layout({_DIMS[0]: len(versions)}, {'reason': str(refusal.reason)[:MAX_REASON]})
    return Int64MultiArray(layout=layout, data=versions)


def from_msg(msg: Int64MultiArray) -> WeightsRefusal:
    """Return the refusal of a message.

    Raises:
        MessageError: the layout is another one, the reason is missing or too long, or the
            good version is not older than the refused one.

    """
    (size,), figures = from_layout(msg.layout, len(msg.data), _DIMS)
    if size != 2:
        raise MessageError(f'data has {size} values: must be 2, the refused version and the good')
    refused, good = (int(value) for value in msg.data)
    if not 0 <= good < refused <= MAX_VERSION:
        raise MessageError(
            f'refused version {refused}, good version {good}: must be '
            f'0 <= good < refused <= {MAX_VERSION}'
        )
    reason = figure(figures, 'reason')
    if len(reason) > MAX_REASON:
        raise MessageError(f'reason has {len(reason)} characters: must be <= {MAX_REASON}')
    return WeightsRefusal(refused, good, reason)
