# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment random`: the network on random solvable scenes, beside the oracle."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from srnn_bringup.experiments.result_files import open_store, write_results
from srnn_bringup.experiments.run import run_with_progress
from srnn_experiments.campaign import Job, Scheduler
from srnn_experiments.random_scene import random_scene
from srnn_experiments.random_scenes_report import as_markdown, report
from srnn_experiments.setting import Setting


def run_random_scenes(
    base: Setting,
    seeds: Sequence[int],
    scheduler: Scheduler,
    directory: Path,
    say: Callable[[str], None],
) -> int:
    """Do one trial for the scene of every seed, with and without knowledge; return 0.

    The seed of a scene is that of its trial as well. Finished trials are kept in
    ``trials.jsonl`` of the directory and not done again.

    Raises:
        ExperimentError: trials cannot be done.
        OSError: a file cannot be written.

    """
    scenes = [replace(base, scene=random_scene(seed)) for seed in seeds]
    network = [Job(setting, seed) for setting, seed in zip(scenes, seeds, strict=True)]
    oracle = [
        Job(replace(setting.with_signal('none'), agent='oracle'), seed)
        for setting, seed in zip(scenes, seeds, strict=True)
    ]
    store = open_store(directory)
    done = run_with_progress([*network, *oracle], scheduler, store, 'random scenes')
    found = report(done[: len(seeds)], done[len(seeds) :])
    title = (
        f'{len(seeds)} random scenes, seeds {seeds[0]} to {seeds[-1]}, '
        f'{base.segments} segments each, {base.place}'
    )
    text = as_markdown(found, title)
    write_results(directory, 'random', found, text)
    say(text.split('\n| seed')[0])
    say(f'report: {directory / "random.md"}, random.json')
    return 0
