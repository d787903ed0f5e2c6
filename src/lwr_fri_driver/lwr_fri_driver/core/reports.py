# SPDX-License-Identifier: Apache-2.0
"""What the process that answers the controller and the node tell each other, as bytes."""

from dataclasses import dataclass
from enum import Enum
import json
import math
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lwr_description import DOF
from lwr_fri_driver.core.connection import Connection
from lwr_fri_driver.core.fitness import in_words
from lwr_fri_driver.core.phase import Phase
from lwr_fri_driver.core.sequence import Arrival
from lwr_fri_driver.errors import DatagramError

Array = NDArray[np.float64]

MAX_SIZE = 1 << 16

_MEASURED = b'M'
_STATUS = b'S'
_COMMAND = b'C'
_SAMPLE = struct.Struct(f'<cq{4 * DOF}d')
_ANGLES = struct.Struct(f'<c{DOF}d')

PERCENTILES = {'p50': 50.0, 'p99': 99.0, 'p999': 99.9, 'max': 100.0}
"""Of the delay of answers, by name."""


class Wish(Enum):
    """What the node asks of the process besides motion."""

    START = b'W'
    STOP = b'N'
    RESET = b'R'


@dataclass(frozen=True, eq=False)
class Sample:
    """What the arm measures.

    Attributes:
        stamp_ns: when the packet arrived [ns of system time].
        values: (4, 7) angles [rad], velocities [rad/s], torques and external torques [Nm].

    """

    stamp_ns: int
    values: Array

    def pack(self) -> bytes:
        """Return it as a message."""
        return _SAMPLE.pack(_MEASURED, self.stamp_ns, *self.values.ravel().tolist())


@dataclass(frozen=True)
class Status:
    """What the process has to say of the conversation.

    Attributes:
        phase: where it is.
        words: why it is there, for a person.
        values: figures, by name.

    """

    phase: Phase
    words: str
    values: dict[str, Any]

    def pack(self) -> bytes:
        """Return it as a message."""
        content = {'phase': self.phase.name, 'words': self.words, 'values': self.values}
        return _STATUS + json.dumps(content).encode()


def unpack_report(message: bytes) -> Sample | Status:
    """Return what the process has said."""
    if message[:1] == _MEASURED:
        _, stamp_ns, *values = _SAMPLE.unpack(message)
        return Sample(stamp_ns, np.array(values).reshape(4, DOF))
    content = json.loads(message[1:])
    return Status(Phase[content['phase']], content['words'], content['values'])


def pack_command(q: Array) -> bytes:
    """Return joint angles (7,) [rad] as a message."""
    return _ANGLES.pack(_COMMAND, *q.tolist())


def unpack_wish(message: bytes) -> Wish | tuple[float, ...]:
    """Return what the node asks: a wish, or joint angles (7,) [rad].

    Raises:
        DatagramError: it is neither.

    """
    if message[:1] == _COMMAND and len(message) == _ANGLES.size:
        return tuple(_ANGLES.unpack(message)[1:])
    try:
        return Wish(message)
    except ValueError as error:
        raise DatagramError(f'{message[:8]!r} is no message of the driver node') from error


def status_of(connection: Connection) -> Status:
    """Return what there is to say of a conversation."""
    link, sequence = connection.link, connection.sequence
    delays = link.delays(PERCENTILES.values())
    values: dict[str, Any] = {
        'malformed': connection.malformed,
        'lost': sequence.lost,
        'doubled': sequence.counts[Arrival.DUPLICATE],
        'late': sequence.counts[Arrival.OLD],
        'clamped': connection.clamped,
        'own_quality': link.quality.name,
        'own_answer_rate': link.share,
        'own_jitter_ms': 1e3 * link.jitter,
        **{f'own_delay_{name}_ms': 1e3 * delay
           for name, delay in zip(PERCENTILES, delays, strict=True)},
        **{f'refused_{reason.name.lower()}': n for reason, n in connection.refused.items()},
    }  # fmt: skip
    if connection.follower is not None:
        values['holds'] = connection.follower.watch.holds
    if connection.measurement is not None:
        values.update(_of_controller(connection))
    return Status(connection.phase, _words(connection), values)


def _of_controller(connection: Connection) -> dict[str, Any]:
    measurement = connection.measurement
    assert measurement is not None
    interface, statistics, robot = (
        measurement.interface, measurement.statistics, measurement.robot
    )
    return {
        'time_s': interface.timestamp,
        'joints_deg': ' '.join(
            f'{math.degrees(angle):.1f}' for angle in measurement.data.joint_position
        ),
        'fri_state': interface.state.name,
        'quality': interface.quality.name,
        'measurement_period_ms': 1e3 * interface.measurement_period,
        'safety_limits': interface.safety_limits,
        'answer_rate': statistics.answer_rate,
        'latency_ms': 1e3 * statistics.latency,
        'jitter_ms': 1e3 * statistics.jitter,
        'misses': statistics.misses,
        'power': f'{robot.power:#x}',
        'control': robot.control.name,
        'error': robot.error,
        'warning': robot.warning,
        'temperature_max': max(robot.temperature),
    }


def _words(connection: Connection) -> str:
    if connection.phase is Phase.FAULT:
        return connection.cause
    if connection.phase is Phase.READYING and connection.unfit:
        return f'{Phase.READYING.value}: {in_words(connection.unfit)}'
    words: str = connection.phase.value
    return words
