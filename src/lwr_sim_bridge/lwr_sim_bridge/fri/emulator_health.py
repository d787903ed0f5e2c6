# SPDX-License-Identifier: Apache-2.0
"""What the FRI emulator says of itself."""

from lwr_sim_bridge.fri.controller import COMMAND, FriController
from srnn_msgs_py.health import Health, HealthLevel

QUALITIES = ('UNACCEPTABLE', 'BAD', 'OK', 'PERFECT')


def emulator_health(controller: FriController, cycles: int, overruns: int) -> Health:
    """Return the state of the controller, and what it thinks of the link.

    Args:
        controller: the emulated one.
        cycles: so many have ended.
        overruns: so many of them a whole cycle late.

    """
    statistics, commanding = controller.statistics, controller.state == COMMAND
    values = {
        'state': 'COMMAND' if commanding else 'MONITOR',
        'quality': QUALITIES[controller.quality],
        'cycles': cycles,
        'overruns': overruns,
        'answer_rate': statistics.answer_rate,
        'latency_ms': 1e3 * statistics.latency,
        'misses': statistics.misses,
        'late': controller.late,
        'rejected': controller.rejected,
    }
    if controller.message:
        return Health(HealthLevel.ERROR, controller.message, values)
    words = 'command mode' if commanding else 'monitor mode'
    return Health(HealthLevel.OK, words, values)
