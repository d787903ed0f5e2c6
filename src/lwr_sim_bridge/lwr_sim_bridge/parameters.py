# SPDX-License-Identifier: Apache-2.0
"""What can be set on the simulated arm, validated once."""

from dataclasses import dataclass, field

from lwr_description import ArmDescription
from lwr_guard import GuardParameters
from srnn_config import Parameters, parameter


@dataclass(frozen=True)
class ImpedanceParameters(Parameters):
    """Joint impedance law of the arm's own controller."""

    stiffness: tuple[float, ...] = parameter(
        (2000.0,) * 7, unit='Nm/rad', above=0.0, maximum=2000.0,
        doc='Stiffness of each joint.',
    )
    damping_ratio: float = parameter(
        0.7, minimum=0.1, maximum=1.5,
        doc='Damping of each joint, as a share of critical for its own inertia.',
    )


@dataclass(frozen=True)
class MismatchParameters(Parameters):
    """What is true of the simulated arm but unknown to its controller and observer."""

    mass_scale: float = parameter(
        1.03, minimum=0.5, maximum=1.5, doc='Mass and inertia of every link over the nominal.'
    )
    payload: float = parameter(
        0.05, unit='kg', minimum=0.0, maximum=2.0, doc='Mass of the tool beyond the nominal.'
    )
    friction: tuple[float, ...] = parameter(
        (0.2, 0.2, 0.2, 0.2, 0.1, 0.05, 0.05), unit='Nm', minimum=0.0, maximum=10.0,
        doc='Dry friction of each joint.',
    )


@dataclass(frozen=True)
class ObserverParameters(Parameters):
    """The arm's own estimate of external torques."""

    gain: float = parameter(
        50.0, unit='1/s', above=0.0, maximum=200.0,
        doc='Bandwidth of the momentum observer; its time constant is 1 / gain.',
    )
    ticks: int = parameter(
        2, minimum=1, maximum=5, doc='The observer runs once in this many 1 ms ticks.'
    )


@dataclass(frozen=True)
class CommandParameters(Parameters):
    """How joint position commands get to the impedance law."""

    time_constant: float = parameter(
        0.004, unit='s', minimum=0.001, maximum=0.05,
        doc='Of the critically damped filter between commands and the impedance law.',
    )
    delay: float = parameter(
        0.0, unit='s', minimum=0.0, maximum=0.05,
        doc='Time on the way from the bridge to the filter, in whole ticks of 1 ms.',
    )


@dataclass(frozen=True)
class ContactParameters(Parameters):
    """Surface of the obstacles."""

    time_constant: float = parameter(
        0.004, unit='s', minimum=0.002, maximum=0.1,
        doc='Of the contact spring; its stiffness goes with 1 / time_constant squared.',
    )
    friction: float = parameter(
        0.3, minimum=0.0, maximum=2.0, doc='Sliding friction between tool and obstacle.'
    )


@dataclass(frozen=True)
class NoiseParameters(Parameters):
    """Sensor noise beyond what the scene file sets."""

    velocity: float = parameter(
        0.005, unit='rad/s', minimum=0.0, maximum=1.0,
        doc='Standard deviation of the measured joint velocities.',
    )
    scale: float = parameter(
        1.0, minimum=0.0, maximum=10.0, doc='Multiplies all sensor noise; 0 switches it off.'
    )


@dataclass(frozen=True)
class ArmParameters(Parameters):
    """All parameters of the simulated arm."""

    impedance: ImpedanceParameters = field(default_factory=ImpedanceParameters)
    mismatch: MismatchParameters = field(default_factory=MismatchParameters)
    observer: ObserverParameters = field(default_factory=ObserverParameters)
    command: CommandParameters = field(default_factory=CommandParameters)
    guard: GuardParameters = field(default_factory=GuardParameters)
    contact: ContactParameters = field(default_factory=ContactParameters)
    noise: NoiseParameters = field(default_factory=NoiseParameters)

    def fit(self, description: ArmDescription) -> None:
        """Refuse lists that have not one value for each joint of the arm.

        Raises:
            ParameterError: names the list.

        """
        description.one_per_joint(self.impedance, 'stiffness', self.impedance.stiffness)
        description.one_per_joint(self.mismatch, 'friction', self.mismatch.friction)
