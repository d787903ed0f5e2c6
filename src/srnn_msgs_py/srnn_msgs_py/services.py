# SPDX-License-Identifier: Apache-2.0
"""Every service that a node offers besides those that ROS gives to every node."""

from collections.abc import Mapping
from types import MappingProxyType

SERVICES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        'planner': (),
        'adapter': ('save', 'load', 'revert'),
        'tracker': ('stop', 'reset', 'pause', 'resume'),
        'sim_bridge': ('reset', 'set_obstacle_*'),
        'mock_arm': (),
        'fri_driver': ('reset',),
        'fri_emulator': ('acknowledge', 'set_obstacle_*'),
    }
)
"""Private names by node; ``*`` stands for the number of an obstacle."""
