# SPDX-License-Identifier: Apache-2.0
"""Journal ↔ std_msgs/Int64MultiArray with session and index beside the rows."""

from array import array

import numpy as np
from std_msgs.msg import Int64MultiArray

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.journal import COLUMNS, WIDTH, Journal
from srnn_msgs_py.ros.layout import from_layout, to_layout, whole

_DIMS = ('rows', '_'.join(COLUMNS))


def to_msg(journal: Journal) -> Int64MultiArray:
    """Return the message of a part of a journal."""
    rows = np.ascontiguousarray(journal.rows, dtype=np.int64)
    figures: dict[str, object] = {'session': int(journal.session), 'index': int(journal.index)}
    layout = to_layout(dict(zip(_DIMS, rows.shape, strict=True)), figures)
    return Int64MultiArray(layout=layout, data=array('q', rows.tobytes()))


def from_msg(msg: Int64MultiArray) -> Journal:
    """Return the part of a journal in a message.

    Raises:
        MessageError: the layout is another one.

    """
    shape, figures = from_layout(msg.layout, len(msg.data), _DIMS)
    if shape[1] != WIDTH:
        raise MessageError(f'rows have {shape[1]} columns: must be {WIDTH}')
    rows = np.array(msg.data, dtype=np.int64).reshape(shape)
    return Journal(whole(figures, 'session'), whole(figures, 'index'), rows)
