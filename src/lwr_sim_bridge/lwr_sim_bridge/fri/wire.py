# SPDX-License-Identifier: Apache-2.0
"""Both datagrams as the controller writes and reads them: little-endian, no padding.

Layout of header revision 1.17 of FRI 1.0, as drivers of the LWR 4+ use it.
"""

from collections.abc import Sequence
from math import isfinite
import struct
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

MEASUREMENT = struct.Struct('<4H 16f 16i 2H f2H3f 4fI 4H7f 7f12f7f7f12f12f7f7f6f42f49f7f')
COMMAND = struct.Struct('<4H 16f 16i 2H I 7f12f7f6f7f7f6f6f')

COUNTERS = 1 << 16
"""Sequence counters wrap here."""

_MEASUREMENT_ID = 0x2006
_COMMAND_ID = 0x1005

Numbers = Sequence[float] | NDArray[np.floating[Any]]


class Reading(NamedTuple):
    """All that a measurement says after its head, in the order of the wire.

    Angles in rad, torques in Nm, poses as 3 x 4 matrices, row by row, in m. The tool wrench
    is Fx, Fy, Fz, Tz, Ty, Tx; the rows of the Jacobian are X, Y, Z, RZ, RY, RX.
    """

    to_reals: Numbers
    to_ints: Sequence[int]
    to_bools: int
    fill: int
    timestamp: float
    state: int
    quality: int
    measurement_period: float
    command_period: float
    safety_limits: float
    answer_rate: float
    latency: float
    jitter: float
    miss_rate: float
    misses: int
    power: int
    control: int
    error: int
    warning: int
    temperature: Numbers
    position: Numbers
    pose: Numbers
    commanded: Numbers
    offset: Numbers
    commanded_pose: Numbers
    pose_offset: Numbers
    torque: Numbers
    external_torque: Numbers
    tool_wrench: Numbers
    jacobian: Numbers
    mass_matrix: Numbers
    gravity: Numbers


class Order(NamedTuple):
    """What of a command the controller acts on.

    Attributes:
        sequence: counter of the sender.
        reflected: counter of the measurement that it answers.
        ints: `$FRI_FRM_INT`, 16 of them.
        flags: which of the following count.
        position: (7,) joint angles [rad].
        torque: (7,) on top of the impedance law [Nm].
        stiffness: (7,) of the joints [Nm/rad].
        damping: (7,) of the joints, as a share of critical.

    """

    sequence: int
    reflected: int
    ints: tuple[int, ...]
    flags: int
    position: tuple[float, ...]
    torque: tuple[float, ...]
    stiffness: tuple[float, ...]
    damping: tuple[float, ...]

    @property
    def finite(self) -> bool:
        """Tell whether every number is one."""
        return all(map(isfinite, self.position + self.torque + self.stiffness + self.damping))


def pack(sequence: int, reflected: int, reading: Reading) -> bytes:
    """Return the 916 bytes of a measurement."""
    numbers: list[float] = [sequence, reflected, MEASUREMENT.size, _MEASUREMENT_ID]
    for field in reading:
        numbers.extend((field,) if np.isscalar(field) else field)  # type: ignore[arg-type]
    return MEASUREMENT.pack(*numbers)


def unpack(data: bytes) -> Order | None:
    """Return what a datagram orders, None if it is no command."""
    if len(data) != COMMAND.size:
        return None
    values = COMMAND.unpack(data)
    sequence, reflected, size, datagram = values[:4]
    if (size, datagram) != (COMMAND.size, _COMMAND_ID):
        return None
    return Order(
        sequence, reflected, values[20:36], values[38], values[39:46], values[58:65],
        values[71:78], values[78:85],
    )
