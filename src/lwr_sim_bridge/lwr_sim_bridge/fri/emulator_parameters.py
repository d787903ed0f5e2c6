# SPDX-License-Identifier: Apache-2.0
"""What the FRI emulator node is told."""

from dataclasses import dataclass, field

from lwr_description import Mount
from lwr_sim_bridge.fri.krl_program import SCHEMES
from lwr_sim_bridge.fri.parameters import ControllerParameters
from lwr_sim_bridge.parameters import ArmParameters
from srnn_config import Parameters, parameter


@dataclass(frozen=True)
class EmulatorParameters(Parameters):
    """Parameters of the FRI emulator node."""

    scene: str = parameter(doc='Scene file with obstacles, sensor noise and start.')
    seed: int = parameter(0, minimum=0, doc='Seed of the sensor noise and of the link faults.')
    cycle: int = parameter(
        5, unit='ms', minimum=1, maximum=100, doc='Time between two packets, argument of friOpen.'
    )
    handshake: str = parameter(
        'ros_control', choices=tuple(SCHEMES), doc='Which KRL program runs.'
    )
    driver: str = parameter('127.0.0.1', doc='Address of the driver.')
    port: int = parameter(49938, minimum=1, maximum=65535, doc='UDP port of the driver.')
    mount: Mount = field(default_factory=Mount)
    arm: ArmParameters = field(default_factory=ArmParameters)
    controller: ControllerParameters = field(default_factory=ControllerParameters)
