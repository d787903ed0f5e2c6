# SPDX-License-Identifier: Apache-2.0
"""What the driver says of itself."""

from lwr_fri_driver.core.phase import Phase
from lwr_fri_driver.core.reports import Status
from srnn_msgs_py.health import Health, HealthLevel

SLEEPING_S = 2.0
"""A process that has not reported for so long sleeps [s]."""

LEVELS = {
    Phase.COMMANDING: HealthLevel.OK,
    Phase.FAULT: HealthLevel.ERROR,
}
"""Of a phase while the node is active; the others are warnings."""


def driver_health(status: Status, silent_for: float, active: bool) -> Health:
    """Return where the conversation with the controller is, and all of its figures.

    Args:
        status: what the process that answers the controller has reported last.
        silent_for: how long ago that was [s].
        active: whether the node is.

    """
    if silent_for > SLEEPING_S:
        return Health(HealthLevel.ERROR, 'the process that answers the controller sleeps')
    values = {'phase': status.phase.name, **status.values}
    level = LEVELS.get(status.phase, HealthLevel.WARN) if active else HealthLevel.OK
    return Health(level, status.words, values)
