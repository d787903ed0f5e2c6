# SPDX-License-Identifier: Apache-2.0
"""Where a message carries the mark of its sender, without a field of its own for it.

Messages with a header: behind the frame, ``srnn_workspace#mark``. Arrays: a dimension of
size 1 at the end, labelled ``mark=...``. Results: a value at the end with the key ``mark``.
"""

from typing import Any, Protocol

from diagnostic_msgs.msg import KeyValue
from std_msgs.msg import MultiArrayDimension

from srnn_access.mark import parse
from srnn_msgs_py.errors import MessageError

SIGN = '#'
"""Separates a frame from the mark."""

FIGURE = 'mark'
"""Name of the mark among figures and values."""

_LABEL = f'{FIGURE}='


class MarkCarrier(Protocol):
    """Puts a mark into messages of one kind, and takes it out again."""

    def put(self, msg: Any, text: str) -> None:
        """Put the text of a mark into a message that has none."""

    def take(self, msg: Any) -> str | None:
        """Remove the mark from a message and return its text; None if there is none."""


class _Header:
    def put(self, msg: Any, text: str) -> None:
        msg.header.frame_id += SIGN + text

    def take(self, msg: Any) -> str | None:
        frame, sign, text = msg.header.frame_id.rpartition(SIGN)
        if not sign:
            return None
        msg.header.frame_id = frame
        return str(text)


class _Layout:
    def put(self, msg: Any, text: str) -> None:
        msg.layout.dim.append(MultiArrayDimension(label=_LABEL + text, size=1, stride=1))

    def take(self, msg: Any) -> str | None:
        dims = msg.layout.dim
        # Size and stride are not kept, hence only those that `put` writes are a mark's.
        if not dims or not dims[-1].label.startswith(_LABEL):
            return None
        if (dims[-1].size, dims[-1].stride) != (1, 1):
            return None
        return str(dims.pop().label.removeprefix(_LABEL))


class _Values:
    def put(self, msg: Any, text: str) -> None:
        msg.values.append(KeyValue(key=FIGURE, value=text))

    def take(self, msg: Any) -> str | None:
        if not msg.values or msg.values[-1].key != FIGURE:
            return None
        return str(msg.values.pop().value)


_BY_FIELD: dict[str, MarkCarrier] = {'header': _Header(), 'layout': _Layout(), 'values': _Values()}


def mark_carrier(message_class: Any) -> MarkCarrier:
    """Return the carrier for a class of messages.

    Raises:
        MessageError: messages of this class have no place for a mark.

    """
    fields = message_class.get_fields_and_field_types()
    for name, carrier in _BY_FIELD.items():
        if name in fields:
            return carrier
    raise MessageError(
        f'{message_class.__name__} has no place for a mark: needs {", ".join(_BY_FIELD)}'
    )


def plain_frame(header: Any) -> str:
    """Return the frame of a header, without the mark if one stands behind it."""
    frame, _, text = header.frame_id.rpartition(SIGN)
    return str(header.frame_id if parse(text) is None else frame)
