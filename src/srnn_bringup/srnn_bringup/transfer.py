# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment transfer`: learn in one world, go on in another, report what was kept."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from srnn_bringup.experiment import run_with_progress
from srnn_bringup.result_files import open_store, write_results
from srnn_config import to_mapping
from srnn_experiments.campaign import Job, Scheduler, outcome_of
from srnn_experiments.store import TrialStore, unpack
from srnn_experiments.transfer import Transfer, new_obstacles
from srnn_experiments.transfer_report import OVERALL, Row, table
from srnn_experiments.transfer_text import as_csv, as_markdown
from srnn_experiments.transfer_trial import TargetTrial, flaws, target_trial

PICTURE = 'transfer.png'


@dataclass(frozen=True, eq=False)
class Jobs:
    """The trials of one row, seed by seed.

    Attributes:
        source: phase 1.
        transferred: phase 2, from the weights of phase 1.
        scratch: the same without these weights.

    """

    source: Sequence[Job]
    transferred: Sequence[Job]
    scratch: Sequence[Job]


def run_transfer(
    transfers: Mapping[str, Transfer],
    seeds: Sequence[int],
    scheduler: Scheduler,
    directory: Path,
    say: Callable[[str], None],
) -> int:
    """Do both phases of all rows with the same seeds and write the report; return 0.

    Finished trials are kept in ``trials.jsonl`` of the directory and not done again.

    Raises:
        ExperimentError: trials cannot be done.
        OSError: a file cannot be written.

    """
    store = open_store(directory)
    jobs = _do(transfers, seeds, scheduler, store)
    rows = {name: _row(transfers[name], of_row, store) for name, of_row in jobs.items()}
    found = table(rows)
    text = as_markdown(transfers, rows, found, seeds, PICTURE)
    report = _report(transfers, jobs, rows, found, store)
    write_results(directory, 'transfer', report, text, as_csv(rows))
    _draw(transfers, jobs, rows, directory / PICTURE)
    say(text.split('\n## ')[0])
    say(f'report: {directory / "transfer.md"}, transfer.csv, transfer.json, {PICTURE}')
    return 0


def _do(
    transfers: Mapping[str, Transfer],
    seeds: Sequence[int],
    scheduler: Scheduler,
    store: TrialStore,
) -> dict[str, Jobs]:
    """Do phase 1, then everything else; return what was done."""
    sources = {name: transfer.source_jobs(seeds) for name, transfer in transfers.items()}
    # Rows with the same source share its trials.
    first = {job.key: job for of_row in sources.values() for job in of_row}
    run_with_progress(list(first.values()), scheduler, store, 'transfer, phase 1')
    jobs = {}
    for name, transfer in transfers.items():
        weights = [unpack(store[job.key]['weights']) for job in sources[name]]
        jobs[name] = Jobs(
            source=sources[name],
            transferred=transfer.target_jobs(seeds, weights),
            scratch=transfer.scratch_jobs(seeds),
        )
    second = [job for of_row in jobs.values() for job in (*of_row.transferred, *of_row.scratch)]
    run_with_progress(second, scheduler, store, 'transfer, phase 2')
    return jobs


def _row(transfer: Transfer, jobs: Jobs, store: TrialStore) -> Row:
    return Row(
        transferred=[target_trial(store[job.key], transfer) for job in jobs.transferred],
        scratch=[target_trial(store[job.key], transfer) for job in jobs.scratch],
        source_learned=[not flaws(store[job.key], transfer.source) for job in jobs.source],
    )


def _report(
    transfers: Mapping[str, Transfer],
    jobs: Mapping[str, Jobs],
    rows: Mapping[str, Row],
    found: Mapping[str, Any],
    store: TrialStore,
) -> dict[str, Any]:
    some = next(iter(transfers.values()))
    brain = some.source.brain
    return {
        'source_scene': some.source.scene.task.name,
        'target_scene': some.target.scene.task.name,
        'segments': some.target.segments,
        'seeds': [trial.seed for trial in next(iter(rows.values())).transferred],
        'network': {'model': to_mapping(brain.model), 'planning': to_mapping(brain.planning)},
        'rows': {
            name: {
                'change': transfer.change,
                'source_world': transfer.source.world,
                'target_world': transfer.target.world,
                'target_arm': to_mapping(transfer.target.arm),
                **found[name],
            }
            for name, transfer in transfers.items()
        },
        OVERALL: found[OVERALL],
        'trials': {
            name: {
                'source': [_figures(job, store) for job in of_row.source],
                'transferred': _judged(of_row.transferred, rows[name].transferred, store),
                'scratch': _judged(of_row.scratch, rows[name].scratch, store),
            }
            for name, of_row in jobs.items()
        },
    }


def _judged(
    jobs: Sequence[Job], trials: Sequence[TargetTrial], store: TrialStore
) -> list[dict[str, Any]]:
    return [
        {**_figures(job, store), 'judged': {**asdict(trial), 'failures': trial.failures}}
        for job, trial in zip(jobs, trials, strict=True)
    ]


def _figures(job: Job, store: TrialStore) -> dict[str, Any]:
    return {key: value for key, value in store[job.key].items() if key != 'weights'}


def _draw(
    transfers: Mapping[str, Transfer],
    jobs: Mapping[str, Jobs],
    rows: Mapping[str, Row],
    path: Path,
) -> None:
    """Draw the first trial that touched the new obstacle; it is done once more for that."""
    from srnn_bringup.plots.transfer_picture import TransferStory, draw

    candidates = [
        (name, job, trial)
        for name, row in rows.items()
        for job, trial in zip(jobs[name].transferred, row.transferred, strict=True)
    ]
    name, job, _ = next((c for c in candidates if c[2].new), candidates[0])
    source, target = transfers[name].source.scene, transfers[name].target.scene
    story = TransferStory(
        title=f'{name}, seed {job.seed}',
        scene=target,
        new=new_obstacles(source, target),
        records=outcome_of(job).records,
    )
    draw(story, path)
