# SPDX-License-Identifier: Apache-2.0
"""The datagram of the controller: what it measures, and what it thinks of the link."""

from dataclasses import dataclass

from lwr_fri_driver.core.datagram import Exchange, Head
from lwr_fri_driver.core.layout import Layout, part, wire
from lwr_fri_driver.core.words import (
    MEASUREMENT_ID,
    MEASUREMENT_SIZE,
    Control,
    FriState,
    Quality,
)
from lwr_fri_driver.errors import DatagramError


@dataclass(frozen=True, slots=True)
class Interface:
    """State of the interface.

    Attributes:
        timestamp: time of the controller [s]; float32, so 4 ms coarse after 9 hours.
        state: what it does with commands.
        quality: what it thinks of the link.
        measurement_period: time between its packets [s].
        command_period: time between the commands it expects [s].
        safety_limits: share of its own limits that holds, the argument of `friStart`.

    """

    timestamp: float = wire(140, 'f', default=0.0)
    state: FriState = wire(144, 'H', kind=FriState, default=FriState.OFF)
    quality: Quality = wire(146, 'H', kind=Quality, default=Quality.UNACCEPTABLE)
    measurement_period: float = wire(148, 'f', default=0.0)
    command_period: float = wire(152, 'f', default=0.0)
    safety_limits: float = wire(156, 'f', default=0.0)


@dataclass(frozen=True, slots=True)
class Statistics:
    """The link as the controller sees it.

    Attributes:
        answer_rate: share of the last 100 packets that were answered.
        latency: of the answers [s].
        jitter: of the answers [s].
        miss_rate: share of answers that did not come in time.
        misses: how many did not.

    """

    answer_rate: float = wire(160, 'f', default=0.0)
    latency: float = wire(164, 'f', default=0.0)
    jitter: float = wire(168, 'f', default=0.0)
    miss_rate: float = wire(172, 'f', default=0.0)
    misses: int = wire(176, 'I')


@dataclass(frozen=True, slots=True)
class Robot:
    """The drives.

    Attributes:
        power: a bit for each drive that is on.
        control: the law that moves the arm.
        error: error bits.
        warning: warning bits.
        temperature: (7,) of the drives [deg C].

    """

    power: int = wire(180, 'H')
    control: Control = wire(182, 'H', kind=Control, default=Control.OTHER)
    error: int = wire(184, 'H')
    warning: int = wire(186, 'H')
    temperature: tuple[float, ...] = wire(188, 'f', 7)


@dataclass(frozen=True, slots=True)
class RobotData:
    """The arm, FRI order and signs.

    Attributes:
        joint_position: (7,) measured [rad].
        pose: (12,) measured pose of the tool, 3 x 4 by rows [R|p], p in [m].
        commanded_joint_position: (7,) commanded without FRI [rad].
        joint_offset: (7,) what FRI adds to it [rad].
        commanded_pose: (12,) commanded without FRI, as `pose`.
        pose_offset: (12,) what FRI adds to it.
        joint_torque: (7,) of the torque sensors [Nm].
        external_torque: (7,) the controller's estimate of external torques [Nm].
        tool_wrench: (6,) its estimate at the tool: Fx, Fy, Fz [N], Tz, Ty, Tx [Nm].
        jacobian: (42,) 6 x 7 by rows X, Y, Z, RZ, RY, RX.
        mass_matrix: (49,) 7 x 7 by rows [kg m^2].
        gravity: (7,) torques that hold the arm [Nm].

    """

    joint_position: tuple[float, ...] = wire(216, 'f', 7)
    pose: tuple[float, ...] = wire(244, 'f', 12)
    commanded_joint_position: tuple[float, ...] = wire(292, 'f', 7)
    joint_offset: tuple[float, ...] = wire(320, 'f', 7)
    commanded_pose: tuple[float, ...] = wire(348, 'f', 12)
    pose_offset: tuple[float, ...] = wire(396, 'f', 12)
    joint_torque: tuple[float, ...] = wire(444, 'f', 7)
    external_torque: tuple[float, ...] = wire(472, 'f', 7)
    tool_wrench: tuple[float, ...] = wire(500, 'f', 6)
    jacobian: tuple[float, ...] = wire(524, 'f', 42)
    mass_matrix: tuple[float, ...] = wire(692, 'f', 49)
    gravity: tuple[float, ...] = wire(888, 'f', 7)


@dataclass(frozen=True, slots=True)
class Measurement:
    """One packet of the controller (MSR)."""

    head: Head = part(Head)
    exchange: Exchange = part(Exchange)
    interface: Interface = part(Interface)
    statistics: Statistics = part(Statistics)
    robot: Robot = part(Robot)
    data: RobotData = part(RobotData)

    @property
    def target(self) -> tuple[float, ...]:
        """Where the controller heads for, (7,) [rad]: what an unchanged command must say.

        Not the measured angles: an arm that yields to a load is elsewhere, and would be told
        to jump there.
        """
        data = self.data
        return tuple(
            commanded + offset
            for commanded, offset in zip(
                data.commanded_joint_position, data.joint_offset, strict=True
            )
        )


LAYOUT = Layout(Measurement, MEASUREMENT_SIZE)


def decode(data: bytes) -> Measurement:
    """Return what the controller has sent.

    Raises:
        DatagramError: it is no measurement of this version of FRI.

    """
    measurement = LAYOUT.unpack(data)
    head = measurement.head
    if (head.size, head.datagram_id) != (MEASUREMENT_SIZE, MEASUREMENT_ID):
        raise DatagramError(
            f'datagram {head.datagram_id:#06x} of {head.size} bytes: '
            f'must be {MEASUREMENT_ID:#06x} of {MEASUREMENT_SIZE}'
        )
    return measurement
