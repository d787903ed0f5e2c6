# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment table1`: every row of the table, written as CSV, JSON and text."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from srnn_bringup.experiments.result_files import open_store, write_results
from srnn_bringup.experiments.run import run_with_progress
from srnn_experiments import table1
from srnn_experiments.campaign import Scheduler, rows
from srnn_experiments.paper import TABLE_1
from srnn_experiments.setting import Setting


def run_table1(
    base: Setting,
    seeds: Sequence[int],
    scheduler: Scheduler,
    directory: Path,
    say: Callable[[str], None],
) -> int:
    """Do the trials of all rows with the same seeds and write the table; return exit code 0.

    Finished trials are kept in ``trials.jsonl`` of the directory and not done again.

    Raises:
        ExperimentError: trials cannot be done.
        OSError: a file cannot be written.

    """
    settings = table1.settings(base)
    jobs = rows(settings, seeds)
    store = open_store(directory)
    run_with_progress(jobs, scheduler, store, 'table1')
    trials = {
        name: [store[setting.digest(), seed] for seed in seeds]
        for name, setting in settings.items()
    }
    table = {name: table1.row(done) for name, done in trials.items()}
    report = _report(base, seeds, table, trials)
    text = _text(base, seeds, table, trials)
    write_results(directory, 'table1', report, text, table1.as_csv(table))
    say(text)
    say(f'table: {directory / "table1.md"}, table1.csv, table1.json')
    return 0


def _report(
    base: Setting,
    seeds: Sequence[int],
    table: Mapping[str, Any],
    trials: Mapping[str, Sequence[Mapping[str, Any]]],
) -> dict[str, Any]:
    return {
        'scene': base.scene.task.name,
        'world': base.world,
        'arm_model': base.arm_model,
        'segments': base.segments,
        'seeds': list(seeds),
        'rows': dict(table),
        'efficiency': table1.efficiencies(trials),
        'laps_local_minus': table1.differences(trials, 'local', 'laps'),
        'paper': {name: asdict(row) for name, row in TABLE_1.items()},
        'trials': {name: list(done) for name, done in trials.items()},
    }


def _text(
    base: Setting,
    seeds: Sequence[int],
    table: Mapping[str, Mapping[str, Any]],
    trials: Mapping[str, Sequence[Mapping[str, Any]]],
) -> str:
    lines = [
        f'# {base.scene.task.name}: {len(seeds)} trials of {base.segments} segments, '
        + base.place,
        '',
        f'Seeds {seeds[0]} to {seeds[-1]}, the same in every row. Mean ± sd over trials '
        '[95 % interval of the mean]. Learned: at least three laps, no contact in the last '
        '100 segments.',
        '',
        table1.as_markdown(table),
        'Laps over those of the oracle: '
        + ', '.join(
            f'{name} {"–" if value is None else format(value, ".2f")}'
            for name, value in table1.efficiencies(trials).items()
        )
        + '.',
        '',
        'Laps of local minus laps of the other rows, seed by seed:',
        '',
    ]
    for name, d in table1.differences(trials, 'local', 'laps').items():
        lines.append(f'* {name}: {d["mean"]:+.2f} [{d["low"]:+.2f}, {d["high"]:+.2f}]')
    return '\n'.join(lines) + '\n'
