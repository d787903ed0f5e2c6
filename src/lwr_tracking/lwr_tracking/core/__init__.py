# SPDX-License-Identifier: Apache-2.0
"""The tracker without middleware: time, measurements and segments are arguments."""

from lwr_tracking.core.errors import ClockError, PathError, TrackingError
from lwr_tracking.core.execution import Finished
from lwr_tracking.core.parameters import (
    ContactParameters,
    GateParameters,
    LawParameters,
    LimitParameters,
    TrackerParameters,
)
from lwr_tracking.core.tracker import Tick, Tracker

__all__ = [
    'ClockError',
    'ContactParameters',
    'Finished',
    'GateParameters',
    'LawParameters',
    'LimitParameters',
    'PathError',
    'Tick',
    'Tracker',
    'TrackerParameters',
    'TrackingError',
]
