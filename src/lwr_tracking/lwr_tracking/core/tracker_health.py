# SPDX-License-Identifier: Apache-2.0
"""What a tracker says of itself."""

from dataclasses import asdict

from lwr_tracking.core.failsafe import Condition, decide
from lwr_tracking.core.silence_watch import SilenceWatch
from lwr_tracking.core.tracker import Tracker
from srnn_msgs_py.health import Health, HealthLevel


def health_at_rest(latched: Condition) -> Health:
    """Return the health of a tracker that is not active, with what it will be stopped by."""
    causes = decide(latched).causes
    return Health(HealthLevel.ERROR if causes else HealthLevel.OK, ', '.join(causes))


def health_at_work(tracker: Tracker, watch: SilenceWatch) -> Health:
    """Return conditions, counters and the last measurement of an active tracker."""
    counters = asdict(tracker.counters)
    refused = {
        f'refused_{reason.name.lower()}': n for reason, n in counters.pop('refused').items()
    }
    values = {
        **counters, **refused,
        'force_n': tracker.contact.force,
        'error_m': tracker.contact.error,
        'longest_silence_ms': 1e3 * watch.longest,
    }  # fmt: skip
    if watch.sample is None:
        return Health(HealthLevel.ERROR, 'no joint states', values)
    decision = decide(tracker.conditions)
    level = HealthLevel.WARN if decision.causes else HealthLevel.OK
    level = HealthLevel.ERROR if decision.latched else level
    return Health(level, ', '.join(decision.causes), values)
