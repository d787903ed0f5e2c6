# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment transfer`: learn in one world, go on in another, report what was kept."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from srnn_bringup.experiments.result_files import open_store, write_results
from srnn_bringup.experiments.run import run_with_progress
from srnn_config import to_mapping
from srnn_experiments.campaign import Job, Scheduler, outcome_of
from srnn_experiments.store import TrialStore, unpack
from srnn_experiments.transfer import Transfer, new_obstacles
from srnn_experiments.transfer_report import Row, table
from srnn_experiments.transfer_text import as_csv, as_markdown
from srnn_experiments.transfer_trial import TargetTrial, flaws, target_trial

PICTURE = 'transfer.png'


@dataclass(frozen=True, eq=False)
class Work:
    """The trials of one row, seed by seed.

    Attributes:
        transfer: the row.
        source: phase 1.
        transferred: phase 2, from the weights of phase 1.
        scratch: the same without these weights.

    """

    transfer: Transfer
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
    works = _do(transfers, seeds, scheduler, store)
    rows = {name: _row(work, store) for name, work in works.items()}
    found = table(rows)
    text = as_markdown(transfers, rows, found, seeds, PICTURE)
    report = _report(works, rows, found, store)
    write_results(directory, 'transfer', report, text, as_csv(rows))
    _draw(works, rows, directory / PICTURE)
    say(text.split('\n## ')[0])
    say(f'report: {directory / "transfer.md"}, transfer.csv, transfer.json, {PICTURE}')
    return 0


def _do(
    transfers: Mapping[str, Transfer],
    seeds: Sequence[int],
    scheduler: Scheduler,
    store: TrialStore,
) -> dict[str, Work]:
    """Do phase 1, then everything else; return what was done."""
    sources = {name: transfer.source_jobs(seeds) for name, transfer in transfers.items()}
    # Rows with the same source share its trials.
    first = {job.key: job for of_row in sources.values() for job in of_row}
    run_with_progress(list(first.values()), scheduler, store, 'transfer, phase 1')
    works = {}
    for name, transfer in transfers.items():
        weights = [unpack(store[job.key]['weights']) for job in sources[name]]
        transferred = transfer.target_jobs(seeds, weights)
        works[name] = Work(transfer, sources[name], transferred, transfer.scratch_jobs(seeds))
    second = [job for work in works.values() for job in (*work.transferred, *work.scratch)]
    run_with_progress(second, scheduler, store, 'transfer, phase 2')
    return works


def _row(work: Work, store: TrialStore) -> Row:
    transfer = work.transfer
    return Row(
        transferred=[target_trial(store[job.key], transfer) for job in work.transferred],
        scratch=[target_trial(store[job.key], transfer) for job in work.scratch],
        source_learned=[not flaws(store[job.key], transfer.source) for job in work.source],
    )


def _report(
    works: Mapping[str, Work],
    rows: Mapping[str, Row],
    found: Mapping[str, Any],
    store: TrialStore,
) -> dict[str, Any]:
    some = next(iter(works.values()))
    source, target = some.transfer.source, some.transfer.target
    return {
        'source_scene': source.scene.task.name,
        'target_scene': target.scene.task.name,
        'segments': target.segments,
        'seeds': [job.seed for job in some.source],
        'network': {
            'model': to_mapping(source.brain.model),
            'planning': to_mapping(source.brain.planning),
        },
        'rows': {
            name: {
                'change': work.transfer.change,
                'source_world': work.transfer.source.world,
                'target_world': work.transfer.target.world,
                'arm_model': work.transfer.target.arm_model,
                'target_arm': to_mapping(work.transfer.target.arm),
                **found[name],
            }
            for name, work in works.items()
        },
        'together': {name: found[name] for name in found if name not in works},
        'trials': {
            name: {
                'source': [_figures(job, store) for job in work.source],
                'transferred': _judged(work.transferred, rows[name].transferred, store),
                'scratch': _judged(work.scratch, rows[name].scratch, store),
            }
            for name, work in works.items()
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


def _draw(works: Mapping[str, Work], rows: Mapping[str, Row], path: Path) -> None:
    """Draw the first trial that touched the new obstacle; it is done once more for that."""
    from srnn_bringup.plots.transfer_picture import TransferStory, draw

    name, number = next(
        ((name, n) for name, row in rows.items() for n, t in enumerate(row.transferred) if t.new),
        (next(iter(rows)), 0),
    )
    transfer, job = works[name].transfer, works[name].transferred[number]
    scene = transfer.target.scene
    story = TransferStory(
        title=f'{name}, seed {job.seed}',
        scene=scene,
        new=new_obstacles(transfer.source.scene, scene),
        records=outcome_of(job).records,
    )
    draw(story, path)
