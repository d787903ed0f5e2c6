# SPDX-License-Identifier: Apache-2.0
"""The figures of one live run, and the document that holds them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from srnn_bringup.config import Configuration
from srnn_bringup.run_recorder import Recorder
from srnn_experiments.document import experiment_document
from srnn_experiments.figures import run_figures

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
    """Return the report of a run as plain data for JSON: an experiment with one trial."""
    trial = {'seed': configuration.seed, **figures(recorder, run)}
    return experiment_document(
        configuration.scene.task.name, configuration.learning, run.limit,
        configuration.seed, WORLD, configuration.arm.mount.description.model, [trial],
    )


def figures(recorder: Recorder, run: Run) -> dict[str, Any]:
    """Return the figures of one run; None for what was never heard of."""
    planner = recorder.figures
    return {
        **run_figures(recorder.records[: run.limit], run.blocked),
        'planning_ms': planning_times(planner),
        'invalid_plans': _whole(planner, 'invalid_plans'),
        'deadline_misses': _whole(planner, 'deadline_misses'),
        'wall_s': run.wall_s,
        'nodes': list(run.nodes),
        'contact_force_peak_n': recorder.force_peak,
    }


def planning_times(planner: Mapping[str, float | int | str]) -> dict[str, float | None]:
    """Return the spread of the planning times [ms] that the planner reports."""
    keys = ('mean', 'sd', 'p50', 'p99')
    if not int(planner.get('planned', 0)):
        return dict.fromkeys(keys)
    return {key: float(planner[f'planning_ms_{key}']) for key in keys}


def _whole(planner: Mapping[str, float | int | str], key: str) -> int | None:
    return int(planner[key]) if key in planner else None
