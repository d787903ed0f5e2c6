# SPDX-License-Identifier: Apache-2.0
"""The figures of one run, and the document that holds them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from srnn_bringup.config import Configuration
from srnn_bringup.recorder import Recorder, SegmentRecord, path_length
from srnn_bringup.spread import mean_sd, spread
from srnn_msgs_py.result import ResultCode

WORLD = 'mujoco'


@dataclass(frozen=True)
class Run:
    """What a run was besides its segments.

    Attributes:
        nodes: names of the nodes that took part.
        wall_s: time from the activation to the end of the last segment [s].
        blocked: index of the way point behind the obstacle.
        limit: segments that count; those after it are left out.

    """

    nodes: Sequence[str]
    wall_s: float
    blocked: int
    limit: int


def document(
    configuration: Configuration, recorder: Recorder, run: Run
) -> dict[str, Any]:
    """Return the report of a run as plain data for JSON.

    It has the layout of an experiment with one trial. Figures that were never heard of
    are None; a standard deviation over one trial is 0.
    """
    trial = {'seed': configuration.seed, **figures(recorder, run)}
    return {
        'scene': configuration.scene.task.name,
        'signal': configuration.learning.signal,
        'alpha': configuration.alpha,
        'segments': run.limit,
        'seed': configuration.seed,
        'world': WORLD,
        'trials': [trial],
        'summary': summary([trial]),
    }


def figures(recorder: Recorder, run: Run) -> dict[str, Any]:
    """Return the figures of one run.

    ``path_length_m`` is the length of everything the tip did, ``segments_to_blocked``
    the number of segments for each visit of the way point behind the obstacle, and
    segments are numbered from 1.
    """
    records = recorder.records[: run.limit]
    touches = [record.number for record in records if record.touched]
    planner = recorder.figures
    return {
        'segments_executed': len(records),
        'updates_triggered': sum(record.updated for record in records),
        'contacts': len(touches),
        'contacts_last_100': _after(touches, len(records) - 100),
        'contacts_last_third': _after(touches, len(records) - len(records) // 3),
        'contact_segments': touches,
        'laps': records[-1].after.laps if records else 0,
        'waypoints_reached': records[-1].after.reached if records else 0,
        'segments_to_blocked': visits(records, run.blocked),
        'planning_ms': planning_times(planner),
        'update_ms': spread([r.lesson.update_ms for r in records if r.lesson and r.updated]),
        'planned_execution_s': mean_sd([record.plan.duration for record in records]),
        'path_length_m': sum(path_length(record.executed.positions) for record in records),
        'invalid_plans': _whole(planner, 'invalid_plans'),
        'deadline_misses': _whole(planner, 'deadline_misses'),
        'wall_s': run.wall_s,
        'nodes': list(run.nodes),
        'tracking_rmse_m': tracking_rmse(records),
        'contact_force_peak_n': recorder.force_peak,
    }


def visits(records: Sequence[SegmentRecord], index: int) -> list[int]:
    """Return how many segments each completed visit of way point `index` took."""
    counts = []
    count = 0
    for record in records:
        if record.before.active != index:
            continue
        count += 1
        if record.reached:
            counts.append(count)
            count = 0
    return counts


def tracking_rmse(records: Sequence[SegmentRecord]) -> float | None:
    """Return the root mean square distance [m] of plan and execution in free motion."""
    squares = [
        ((record.plan.positions - record.executed.positions) ** 2).sum(axis=1)
        for record in records
        if record.result.code is ResultCode.DONE
    ]
    return float(np.sqrt(np.concatenate(squares).mean())) if squares else None


def planning_times(planner: Mapping[str, float | int | str]) -> dict[str, float | None]:
    """Return the spread of the planning times [ms] that the planner reports."""
    keys = ('mean', 'sd', 'p50', 'p99')
    if not int(planner.get('planned', 0)):
        return dict.fromkeys(keys)
    return {key: float(planner[f'planning_ms_{key}']) for key in keys}


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


def _whole(planner: Mapping[str, float | int | str], key: str) -> int | None:
    return int(planner[key]) if key in planner else None
