# SPDX-License-Identifier: Apache-2.0
"""The figures of one run, and of many."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from srnn_experiments.segment_record import SegmentRecord, path_length
from srnn_experiments.spread import mean_sd, spread
from srnn_experiments.visits import visit_lengths
from srnn_msgs_py.result import ResultCode

LATE = 100
"""Segments at the end of a run by which it is judged."""


def run_figures(records: Sequence[SegmentRecord], blocked: int) -> dict[str, Any]:
    """Return the figures that follow from the segments of a run.

    ``path_length_m`` is the length of everything the tip did, ``segments_to_blocked``
    the number of segments for each visit of the way point behind the obstacle,
    ``still_reached`` tells whether every way point was reached in the last 100
    segments, ``contact_points_m`` are where the tip was measured at the contacts, and
    segments are numbered from 1.

    Args:
        records: segments of the run, in order.
        blocked: index of the way point behind the obstacle.

    """
    touched = [record for record in records if record.touched]
    touches = [record.number for record in touched]
    return {
        'segments_executed': len(records),
        'updates_triggered': sum(record.updated for record in records),
        'contacts': len(touches),
        'contacts_last_100': _after(touches, len(records) - LATE),
        'contacts_last_third': _after(touches, len(records) - len(records) // 3),
        'contact_segments': touches,
        'contact_points_m': [record.executed.positions[-1, :2].tolist() for record in touched],
        'laps': records[-1].after.laps if records else 0,
        'waypoints_reached': records[-1].after.reached if records else 0,
        'segments_to_blocked': visit_lengths(
            [r.before.active for r in records], [r.reached for r in records], blocked
        ).completed,
        'still_reached': still_reached(records),
        'planning_ms': spread([r.planning_ms for r in records if r.planning_ms is not None]),
        'update_ms': spread([r.lesson.update_ms for r in records if r.lesson and r.updated]),
        'planned_execution_s': mean_sd([record.plan.duration for record in records]),
        'path_length_m': sum(path_length(record.executed.positions) for record in records),
        'tracking_rmse_m': tracking_rmse(records),
    }


def still_reached(records: Sequence[SegmentRecord]) -> bool:
    """Tell whether every way point was reached in the last `LATE` segments."""
    late = {record.before.active for record in records[-LATE:] if record.reached}
    return bool(records) and len(late) == len(records[-1].after.waypoints)


def tracking_rmse(records: Sequence[SegmentRecord]) -> float | None:
    """Return the root mean square distance [m] of plan and execution in free motion."""
    squares = [
        ((record.plan.positions - record.executed.positions) ** 2).sum(axis=1)
        for record in records
        if record.result.code is ResultCode.DONE
    ]
    return float(np.sqrt(np.concatenate(squares).mean())) if squares else None


def summary(trials: Sequence[Mapping[str, Any]]) -> dict[str, dict[str, float | None]]:
    """Return mean and deviation over trials of every figure that is a number or has a mean."""
    result = {}
    for key in trials[0]:
        values = [_number(trial[key]) for trial in trials]
        if key != 'seed' and any(value is not None for value in values):
            result[key] = mean_sd([value for value in values if value is not None])
    return result


def _number(value: Any) -> float | None:
    if isinstance(value, Mapping):
        value = value.get('mean')
    return float(value) if isinstance(value, int | float) else None


def _after(numbers: Sequence[int], number: int) -> int:
    return sum(n > number for n in numbers)
