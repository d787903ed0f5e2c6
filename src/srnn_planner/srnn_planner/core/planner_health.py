# SPDX-License-Identifier: Apache-2.0
"""What a planner says of itself."""

from dataclasses import asdict

from srnn_msgs_py.health import Health, HealthLevel
from srnn_planner.core.planning_session import PlanningSession
from srnn_planner.core.statistics import Durations


def planner_health(
    session: PlanningSession, planning_times: Durations, stamp_ns: int, doubts: str
) -> Health:
    """Return counters, planning times and what is wrong.

    Args:
        session: decides.
        planning_times: of the segments that were sent.
        stamp_ns: stamp of the last of them, 0 before the first [ns].
        doubts: what is doubted, empty for nothing.

    """
    watch = session.watched.watch
    counters = asdict(session.sequencer.counters)
    times = {f'planning_ms_{k}': v for k, v in planning_times.summary_ms().items()}
    values = {
        **counters,
        **times,
        'planning_ms': 1e3 * planning_times.last,
        'segment_stamp_ns': stamp_ns,
        'weights_version': watch.in_use.version,
        'weights_refused': watch.refusals,
    }
    level = HealthLevel.WARN if doubts or counters['invalid_plans'] else HealthLevel.OK
    return Health(HealthLevel.ERROR if watch.trouble else level, watch.trouble or doubts, values)
