# SPDX-License-Identifier: Apache-2.0
"""What the planner node is told."""

from dataclasses import dataclass, field

from srnn_config import Parameters, parameter
from srnn_planner.core.parameters import ModelParameters, PlanningParameters


@dataclass(frozen=True)
class PlannerParameters(Parameters):
    """Parameters of the planner node."""

    scene: str = parameter(doc='Scene file with way points, reach radius and velocity.')
    seed: int = parameter(0, minimum=0, doc='Seed of all random numbers of the planner.')
    model: ModelParameters = field(default_factory=ModelParameters)
    planning: PlanningParameters = field(default_factory=PlanningParameters)
