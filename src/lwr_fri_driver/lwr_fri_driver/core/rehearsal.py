# SPDX-License-Identifier: Apache-2.0
"""A conversation with a controller that is none, so that no step of the real one is the first."""

from dataclasses import replace

import numpy as np

from lwr_description import DOF
from lwr_fri_driver.core.connection import Connection
from lwr_fri_driver.core.datagram import Head
from lwr_fri_driver.core.fitness import Gravity
from lwr_fri_driver.core.joint_velocity import JointVelocity
from lwr_fri_driver.core.measurement import LAYOUT, Interface, Measurement, Robot, RobotData
from lwr_fri_driver.core.parameters import STRATEGIES, DriverParameters
from lwr_fri_driver.core.phase import Phase
from lwr_fri_driver.core.reports import Sample, pack_command, status_of, unpack_wish
from lwr_fri_driver.core.words import (
    DRIVES_ON,
    MEASUREMENT_ID,
    MEASUREMENT_SIZE,
    FriState,
    Quality,
)

PACKETS, COMMANDED = 500, 10
"""Most packets of a rehearsal, and how many of them are answered in command mode."""


def rehearse(parameters: DriverParameters, gravity: Gravity) -> bool:
    """Go all the way to command mode, be commanded, and leave it; nothing is sent.

    What Python, NumPy and MuJoCo do for the first time takes longer than a cycle.

    Args:
        parameters: of the driver.
        gravity: torques (7,) [Nm] that hold the model at angles (7,) [rad].

    Returns:
        Whether command mode was reached.

    """
    cycle, rest = parameters.link.cycle, np.zeros(DOF)
    velocity = JointVelocity(cycle, parameters.control.velocity_time_constant)
    hasty = replace(parameters, safety=replace(parameters.safety, steady=0.1))
    connection = Connection(hasty, gravity)
    connection.request(True)
    said = Measurement(
        interface=Interface(
            quality=Quality.PERFECT, measurement_period=cycle, command_period=cycle,
            safety_limits=1.0,
        ),
        robot=Robot(power=DRIVES_ON, control=STRATEGIES[parameters.control.strategy]),
        data=RobotData(gravity=tuple(gravity(rest).tolist())),
    )  # fmt: skip
    commanded = 0
    for sequence in range(PACKETS):
        started = connection.phase in (Phase.STARTING, Phase.COMMANDING)
        state = FriState.COMMAND if started else FriState.MONITOR
        head = Head(sequence, 0, MEASUREMENT_SIZE, MEASUREMENT_ID)
        packet = replace(said, head=head, interface=replace(said.interface, state=state))
        connection.answer(LAYOUT.pack(packet), sequence * cycle)
        connection.link.answered(0.0)
        if connection.commanding:
            asked = unpack_wish(pack_command(rest))
            assert isinstance(asked, tuple)
            connection.command(asked, sequence * cycle)
            values = np.array([rest, velocity.update(rest, 1), rest, rest])
            Sample(0, values).pack()
            commanded += 1
            connection.request(commanded < COMMANDED)
        elif commanded and connection.phase is Phase.MONITOR:
            break
    status_of(connection).pack()
    return commanded == COMMANDED
