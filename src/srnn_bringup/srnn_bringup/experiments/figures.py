# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment figures`: the figures of the paper's evaluation, with their numbers."""

from collections.abc import Callable, Sequence
import json
from pathlib import Path

from srnn_bringup.experiments.run import run_with_progress
from srnn_bringup.plots.paper_figures import FIGURES
from srnn_experiments.campaign import Scheduler
from srnn_experiments.evaluation.trials import Evaluation, evaluation, jobs
from srnn_experiments.setting import Setting
from srnn_experiments.store import TrialStore


def run_paper_figures(
    base: Setting,
    seeds: Sequence[int],
    long: int,
    scheduler: Scheduler,
    directory: Path,
    say: Callable[[str], None],
) -> int:
    """Do the trials of all figures and write a PNG and a JSON for each; return exit code 0.

    Finished trials are kept in ``trials.jsonl`` of the directory and not done again.

    Args:
        base: scene, network, world, and length of the trials.
        seeds: of the trials of every setting.
        long: length of the trials with a constant rate [segments].
        scheduler: where to do them.
        directory: where to write.
        say: told what was found and written.

    Raises:
        ExperimentError: trials cannot be done.
        OSError: a file cannot be written.

    """
    directory.mkdir(parents=True, exist_ok=True)
    store = TrialStore(directory / 'trials.jsonl')
    todo = [job for group in jobs(base, seeds, long).values() for job in group]
    run_with_progress(todo, scheduler, store, 'figures')
    done = evaluation(base, seeds, long, lambda job: store[job.key])
    text = _write(done, directory)
    (directory / 'figures.md').write_text(text)
    say(text)
    say(f'figures: {directory / "figures.md"}, {len(FIGURES)} PNG files and their numbers')
    return 0


def _write(done: Evaluation, directory: Path) -> str:
    """Write PNG and JSON of every figure and return what is to be said of them."""
    base = done.base
    sections = [
        f'# {base.scene.task.name}: {len(done.seeds)} trials, {base.place}\n\n'
        f'Seeds {done.seeds[0]} to {done.seeds[-1]}, the same for every setting; '
        f'{base.segments} segments, {done.long} with a constant rate. Mean ± sd over trials '
        '[95 % interval].'
    ]
    for name, figure in FIGURES.items():
        content = figure.content
        found = content.numbers(done)
        document = json.dumps(found, indent=1, allow_nan=False)
        (directory / f'{name}.json').write_text(document + '\n')
        figure.draw(found, content.headline(found), directory / f'{name}.png')
        lines = '\n'.join(f'* {line}' for line in content.key_numbers(found))
        sections.append(
            f'## {content.headline(found)}\n\n![{name}]({name}.png)\n\n'
            f'{content.caption(found)} Numbers: [{name}.json]({name}.json).\n\n{lines}'
        )
    return '\n\n'.join(sections) + '\n'
