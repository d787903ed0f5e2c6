# SPDX-License-Identifier: Apache-2.0
"""What the adapter node is told."""

from dataclasses import dataclass, field

from srnn_config import Parameters, parameter
from srnn_planner.core.parameters import ModelParameters


@dataclass(frozen=True)
class AdapterParameters(Parameters):
    """Parameters of the adapter node."""

    seed: int = parameter(0, minimum=0, doc='Seed of all random numbers of the adapter.')
    initial_weights: str = parameter('', doc='Weight file to start from; empty for the prior.')
    weights_file: str = parameter('', doc='File of the services ~/save and ~/load.')
    checkpoint: str = parameter(
        '', doc='File that keeps every update before it is shared, and that a restarted adapter '
        'goes on from; empty for none.',
    )
    model: ModelParameters = field(default_factory=ModelParameters)
