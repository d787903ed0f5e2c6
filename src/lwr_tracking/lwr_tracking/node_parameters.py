# SPDX-License-Identifier: Apache-2.0
"""What the tracker node is told."""

from dataclasses import dataclass, field

from lwr_description import Mount
from lwr_tracking.core.parameters import TrackerParameters
from srnn_config import Parameters, parameter


@dataclass(frozen=True)
class TrackerNodeParameters(Parameters):
    """Parameters of the tracker node."""

    latch: str = parameter(
        '', doc='File that keeps what has stopped the arm until reset, so that a successor does '
        'not move it either; empty for none.',
    )
    mount: Mount = field(default_factory=Mount)
    tracking: TrackerParameters = field(default_factory=TrackerParameters)
