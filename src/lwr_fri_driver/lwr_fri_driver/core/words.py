# SPDX-License-Identifier: Apache-2.0
"""The numbers of FRI 1.0 that stand for words."""

from enum import Enum, IntFlag

MEASUREMENT_ID = 0x2006
COMMAND_ID = 0x1005
MEASUREMENT_SIZE = 916
COMMAND_SIZE = 376

DRIVES_ON = 0x7F
"""Power bits of seven drives that are on; a controller may set more bits than these."""


class FriState(Enum):
    """What the controller does with commands."""

    OFF = 0
    MONITOR = 1
    COMMAND = 2
    INVALID = 0xFFFF


class Quality(Enum):
    """What the controller thinks of the link."""

    UNACCEPTABLE = 0
    BAD = 1
    OK = 2
    PERFECT = 3
    INVALID = 0xFFFF

    @property
    def fit(self) -> bool:
        """Tell whether the arm may be commanded; below OK the controller gives up by itself."""
        return self in (Quality.OK, Quality.PERFECT)


class Control(Enum):
    """By which law the controller moves the arm."""

    OTHER = 0
    POSITION = 1
    CARTESIAN_IMPEDANCE = 2
    JOINT_IMPEDANCE = 3


class Flags(IntFlag):
    """Which fields of a command count."""

    JOINT_POSITION = 0x0001
    JOINT_TORQUE = 0x0004
    JOINT_STIFFNESS = 0x0010
    JOINT_DAMPING = 0x0020
