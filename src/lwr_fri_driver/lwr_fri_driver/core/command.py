# SPDX-License-Identifier: Apache-2.0
"""The datagram of the driver: what the controller is told."""

from dataclasses import dataclass

from lwr_fri_driver.core.datagram import Exchange, Head
from lwr_fri_driver.core.layout import Layout, part, wire
from lwr_fri_driver.core.words import COMMAND_ID, COMMAND_SIZE


@dataclass(frozen=True, slots=True)
class Motion:
    """What the arm is to do; FRI order and signs.

    Attributes:
        flags: which of the fields count.
        joint_position: (7,) where to head for [rad].
        pose: (12,) of the tool, 3 x 4 by rows.
        joint_torque: (7,) on top of the impedance law [Nm].
        tool_wrench: (6,) on top of the impedance law: Fx, Fy, Fz [N], Tz, Ty, Tx [Nm].
        joint_stiffness: (7,) [Nm/rad].
        joint_damping: (7,) as a share of critical.
        stiffness: (6,) of the tool [N/m] and [Nm/rad].
        damping: (6,) of the tool, as a share of critical.

    """

    flags: int = wire(140, 'I')
    joint_position: tuple[float, ...] = wire(144, 'f', 7)
    pose: tuple[float, ...] = wire(172, 'f', 12)
    joint_torque: tuple[float, ...] = wire(220, 'f', 7)
    tool_wrench: tuple[float, ...] = wire(248, 'f', 6)
    joint_stiffness: tuple[float, ...] = wire(272, 'f', 7)
    joint_damping: tuple[float, ...] = wire(300, 'f', 7)
    stiffness: tuple[float, ...] = wire(328, 'f', 6)
    damping: tuple[float, ...] = wire(352, 'f', 6)


@dataclass(frozen=True, slots=True)
class Command:
    """One packet of the driver (CMD)."""

    head: Head = part(Head)
    exchange: Exchange = part(Exchange)
    motion: Motion = part(Motion)


LAYOUT = Layout(Command, COMMAND_SIZE)


def encode(sequence: int, reflected: int, exchange: Exchange, motion: Motion) -> bytes:
    """Return the answer to a measurement.

    Args:
        sequence: counter of this answer.
        reflected: counter of the measurement.
        exchange: what the KRL program is told.
        motion: what the arm is to do.

    Raises:
        DatagramError: a value does not fit into its field.

    """
    head = Head(sequence, reflected, COMMAND_SIZE, COMMAND_ID)
    return LAYOUT.pack(Command(head, exchange, motion))
