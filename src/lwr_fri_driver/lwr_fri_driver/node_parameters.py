# SPDX-License-Identifier: Apache-2.0
"""What the FRI driver node is told."""

from dataclasses import dataclass, field

from lwr_description import Mount
from lwr_fri_driver.core.parameters import DriverParameters
from srnn_config import Parameters


@dataclass(frozen=True)
class DriverNodeParameters(Parameters):
    """Parameters of the FRI driver node."""

    mount: Mount = field(default_factory=Mount)
    fri: DriverParameters = field(default_factory=DriverParameters)
