# SPDX-License-Identifier: Apache-2.0
"""What is in each configuration file."""

from dataclasses import dataclass, field

from lwr_description import Mount
from lwr_fri_driver.core.parameters import DriverParameters
from lwr_sim_bridge.fri.parameters import ControllerParameters
from lwr_sim_bridge.parameters import ArmParameters
from lwr_tracking.core.parameters import TrackerParameters
from srnn_config import Parameters, parameter
from srnn_planner.core.parameters import ModelParameters, PlanningParameters


@dataclass(frozen=True)
class NetworkFile(Parameters):
    """The spiking network: what it is and learns (model), and how it plans (planning)."""

    model: ModelParameters = field(default_factory=ModelParameters)
    planning: PlanningParameters = field(default_factory=PlanningParameters)


@dataclass(frozen=True)
class ArmFile(Parameters):
    """An arm: which one, where it stands and what it holds (mount), how it is simulated (arm)."""

    mount: Mount = field(default_factory=Mount)
    arm: ArmParameters = field(default_factory=ArmParameters)

    def check(self) -> None:
        """Refuse parameters of the simulation that do not fit the arm."""
        self.arm.fit(self.mount.description)


@dataclass(frozen=True)
class TrackingFile(Parameters):
    """Tracking: which segments are accepted, how they are followed, what counts as contact."""

    tracking: TrackerParameters = field(default_factory=TrackerParameters)


@dataclass(frozen=True)
class FriFile(Parameters):
    """The arm over FRI: how its controller is talked to (fri), followed, and emulated."""

    lead: float = parameter(
        0.028, unit='s', minimum=0.0, maximum=0.1,
        doc='Time by which commands run ahead of where the measured tip should be, in place of '
        'tracking.law.lead.',
    )
    fri: DriverParameters = field(default_factory=DriverParameters)
    emulator: ControllerParameters = field(default_factory=ControllerParameters)


FILES: dict[str, type[Parameters]] = {
    'network.yaml': NetworkFile,
    'arms/lwr4p.yaml': ArmFile,
    'tracking.yaml': TrackingFile,
    'fri.yaml': FriFile,
}
"""Name of every configuration file and what it holds."""
