# SPDX-License-Identifier: Apache-2.0
"""What becomes of a message: judged, converted, handed on."""

from collections.abc import Callable
import time
from typing import Any, Generic, TypeVar

from srnn_access import Refusal
from srnn_msgs_py.errors import MessageError
from srnn_node.inlet import Inlet

V = TypeVar('V')


class Reception(Generic[V]):
    """One topic of one listener. Who may not send is dropped before anything else."""

    def __init__(
        self,
        inlet: Inlet,
        convert: Callable[[Any], V],
        callback: Callable[[V], None],
        not_in_charge: Callable[[V], None] | None,
        not_converted: Callable[[], None],
    ) -> None:
        """Hand on what arrives.

        Args:
            inlet: judges and counts senders.
            convert: turns a message into a value, or raises MessageError.
            callback: gets the value.
            not_in_charge: gets what a known sender has sent while another is in charge.
            not_converted: told of every message that could not be converted.

        """
        self._inlet = inlet
        self._convert = convert
        self._callback = callback
        self._not_in_charge = not_in_charge
        self._not_converted = not_converted

    def receive(self, msg: Any) -> None:
        """Take in a message."""
        take: Callable[[V], None] | None = self._callback
        refusal = self._inlet.judge(msg, time.monotonic(), time.time_ns())
        if refusal is not None:
            take = self._not_in_charge if refusal is Refusal.NOT_OWNER else None
        if take is None:
            return
        try:
            value = self._convert(msg)
        except MessageError:
            self._not_converted()
            return
        take(value)
