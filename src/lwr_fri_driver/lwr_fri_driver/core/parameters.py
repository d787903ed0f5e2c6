# SPDX-License-Identifier: Apache-2.0
"""What can be set on the driver, validated once."""

from dataclasses import dataclass, field

from lwr_fri_driver.core.handshake import HANDSHAKES
from lwr_fri_driver.core.words import Control
from lwr_guard import GuardParameters
from srnn_config import Parameters, parameter

STRATEGIES = {
    'joint_position': Control.POSITION,
    'joint_impedance': Control.JOINT_IMPEDANCE,
}
"""Laws that the controller can be asked for, by name."""


@dataclass(frozen=True)
class LinkParameters(Parameters):
    """Where the controller is, and how it is talked to."""

    port: int = parameter(
        49938, minimum=1, maximum=65535,
        doc='UDP port that the controller sends to (FRISOCK in its dlrrc.ini, or friSetup).',
    )
    controller: str = parameter(
        '', doc='Address of the controller; empty for the first that speaks FRI to the port.'
    )
    cycle: float = parameter(
        0.005, unit='s', minimum=0.001, maximum=0.1,
        doc='Time between two packets of the controller, the argument of friOpen.',
    )
    handshake: str = parameter(
        'ros_control', choices=tuple(HANDSHAKES),
        doc='What the KRL program on the controller and the driver tell each other.',
    )
    time_out: float = parameter(
        0.1, unit='s', minimum=0.01, maximum=1.0,
        doc='Without a packet for this long the controller is gone.',
    )
    answer_time: float = parameter(
        10.0, unit='s', above=0.0, maximum=120.0,
        doc='The KRL program must have started or stopped command mode within this.',
    )

    def check(self) -> None:
        """Refuse a cycle that friOpen cannot be asked for."""
        if abs(1e3 * self.cycle - round(1e3 * self.cycle)) > 1e-9:
            raise self.refuse('cycle', self.cycle, 'a whole number of milliseconds')


@dataclass(frozen=True)
class ControlParameters(Parameters):
    """By which law the controller moves the arm."""

    strategy: str = parameter(
        'joint_impedance', choices=tuple(STRATEGIES), doc='Law of the controller in command mode.'
    )
    stiffness: tuple[float, ...] = parameter(
        (1000.0,) * 7, unit='Nm/rad', length=7, minimum=0.01, maximum=2000.0,
        doc='Stiffness of each joint in joint impedance, FRI order.',
    )
    damping: tuple[float, ...] = parameter(
        (0.7,) * 7, length=7, minimum=0.1, maximum=1.0,
        doc='Damping of each joint in joint impedance, as a share of critical, FRI order.',
    )
    time_constant: float = parameter(
        0.004, unit='s', minimum=0.001, maximum=0.05,
        doc='Of the critically damped filter between the commands and what the controller gets.',
    )
    velocity_time_constant: float = parameter(
        0.005, unit='s', minimum=0.0, maximum=0.1,
        doc='Of the low-pass behind joint velocities, which the controller does not send.',
    )
    velocity_share: float = parameter(
        0.5, above=0.0, maximum=1.0,
        doc='Share of the joint velocity limits that the controller is asked for at most.',
    )


@dataclass(frozen=True)
class SafetyParameters(Parameters):
    """When the arm may be commanded, and when no longer."""

    steady: float = parameter(
        0.5, unit='s', minimum=0.1, maximum=60.0,
        doc='The controller must be fit without a break for this long before command mode.',
    )
    poor_cycles: int = parameter(
        5, minimum=1, maximum=1000,
        doc='More cycles in a row with a quality below OK end command mode.',
    )
    silence: float = parameter(
        0.02, unit='s', minimum=0.001, maximum=0.1,
        doc='Without a good joint command for this long the arm holds its pose.',
    )
    patience: float = parameter(
        1.0, unit='s', minimum=0.1, maximum=60.0,
        doc='Without a good joint command for this long command mode ends.',
    )
    position_margin: float = parameter(
        0.017, unit='rad', minimum=0.0, maximum=0.5,
        doc='Measured angles nearer to a joint limit than this end command mode.',
    )
    load_tolerance: float = parameter(
        4.0, unit='Nm', above=0.0, maximum=200.0,
        doc='Largest difference between the gravity torques of the controller and those of the '
        'model; a larger one is wrong load data, or a base that stands otherwise.',
    )


@dataclass(frozen=True)
class DriverParameters(Parameters):
    """All parameters of the driver."""

    link: LinkParameters = field(default_factory=LinkParameters)
    control: ControlParameters = field(default_factory=ControlParameters)
    safety: SafetyParameters = field(default_factory=SafetyParameters)

    def check(self) -> None:
        """Refuse a silence that is shorter than a cycle."""
        if self.safety.silence < self.link.cycle:
            raise self.refuse(
                'safety.silence', self.safety.silence, f'>= link.cycle = {self.link.cycle:g} s'
            )

    @property
    def guard(self) -> GuardParameters:
        """What a stream of joint commands must keep to."""
        return GuardParameters(self.link.cycle, self.safety.silence)
