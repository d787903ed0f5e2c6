# SPDX-License-Identifier: Apache-2.0
"""How a node is doing, in one line and a few counters."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum


class HealthLevel(IntEnum):
    """Severity, numbered as in diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3


@dataclass(frozen=True)
class Health:
    """What a node tells about itself once a second.

    Attributes:
        level: severity.
        message: one line for a person.
        values: named figures; the name carries the unit, for example ``force_n``.

    """

    level: HealthLevel = HealthLevel.OK
    message: str = ''
    values: Mapping[str, float | int | str] = field(default_factory=dict)


def in_namespace(healths: Mapping[str, Health], namespace: str) -> dict[str, Health]:
    """Return the health of those nodes that are in a namespace.

    Args:
        healths: health of nodes by full name.
        namespace: absolute namespace.

    """
    return {
        name: health
        for name, health in healths.items()
        if (name.rpartition('/')[0] or '/') == namespace
    }
