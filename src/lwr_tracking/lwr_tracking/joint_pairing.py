# SPDX-License-Identifier: Apache-2.0
"""Makes one measurement of two messages: joint state and external torque."""

from collections.abc import Sequence
from typing import Any

from srnn_msgs_py.errors import MessageError
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import joints

MAX_LAG = 0.01
"""Largest difference in time between joint state and external torque [s]."""


class JointPairing:
    """Puts each joint state together with the newest external torque.

    Attributes:
        external: message with the newest external torque, None before the first.

    """

    def __init__(self, names: Sequence[str]) -> None:
        """Expect these joints."""
        self.external: Any = None
        self._names = names

    def keep(self, external: Any) -> None:
        """Take in a message with external torques."""
        self.external = external

    def pair(self, measured: Any) -> JointSample:
        """Return the measurement that a joint state completes.

        Raises:
            MessageError: the two do not fit together, or there is no external torque yet.

        """
        if self.external is None:
            raise MessageError('no external torque yet')
        return joints.from_msgs(measured, self.external, self._names, MAX_LAG)
