# SPDX-License-Identifier: Apache-2.0
"""One node of the graph as data."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class NodeDescription:
    """One node of the graph.

    Attributes:
        name: name of the node.
        package: ROS package that installs it.
        executable: its name for ``ros2 run``.
        module: its name for ``python -m``.
        parameters: nested parameter mapping of plain data.

    """

    name: str
    package: str
    executable: str
    module: str
    parameters: Mapping[str, Any]
