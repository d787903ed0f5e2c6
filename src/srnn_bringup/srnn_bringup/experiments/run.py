# SPDX-License-Identifier: Apache-2.0
"""`srnn experiment run`: many trials on simulated time."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from srnn_bringup.config import Configuration
from srnn_bringup.exit_codes import DONE
from srnn_bringup.speech import STDOUT, progress, write_document
from srnn_experiments.agent import Brain
from srnn_experiments.campaign import Job, Scheduler, run_jobs, trials
from srnn_experiments.document import experiment_document
from srnn_experiments.schedulers import DaskCluster, LocalProcesses
from srnn_experiments.setting import Setting
from srnn_experiments.store import TrialStore, unpack
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import weights_file


@dataclass(frozen=True)
class Experiment:
    """What `srnn experiment run` is asked for.

    Attributes:
        segments: length of a trial.
        trials: how many.
        seed: of the first trial; the others follow.
        world: mujoco or point.
        agent: network, oracle or grid.
        workers: processes on this machine; None for one per core.
        scheduler: address of a Dask scheduler; None for this machine.
        json: file for the figures, or `STDOUT`; None for none.
        save_weights: file for the weights at the end of the first trial.

    """

    segments: int
    trials: int
    seed: int
    world: str
    agent: str
    workers: int | None = None
    scheduler: str | None = None
    json: Path | None = None
    save_weights: Path | None = None


def base_setting(
    configuration: Configuration, segments: int, world: str, agent: str = 'network'
) -> Setting:
    """Return the setting that a configuration describes."""
    network = configuration.network
    given = configuration.initial_weights is not None
    return Setting(
        scene=configuration.scene,
        brain=Brain(network.model, network.planning),
        segments=segments,
        world=world,
        agent=agent,
        mount=configuration.arm.mount,
        arm=configuration.arm.arm,
        tracking=configuration.tracking.tracking,
        weights=configuration.start_weights().learned if given else None,
    )


def make_scheduler(workers: int | None, address: str | None) -> Scheduler:
    """Return where trials are done."""
    return LocalProcesses(workers) if address is None else DaskCluster(address)


def run_with_progress(
    jobs: Sequence[Job], scheduler: Scheduler, store: TrialStore, title: str
) -> list[dict[str, Any]]:
    """Do jobs and show on the terminal how far they are."""
    with progress(len(jobs), title, 'trial') as bar:
        return run_jobs(jobs, scheduler, store, bar.update)


def run_experiment(
    configuration: Configuration, asked: Experiment, say: Callable[[str], None]
) -> int:
    """Do the trials, write the files, and say the summary; return exit code 0.

    Until all trials are done, those that are lie beside the JSON file, in a file of the
    same name that ends in ``.partial``; the same command goes on from there.

    Raises:
        ExperimentError: trials cannot be done.
        OSError: a file cannot be written.

    """
    setting = base_setting(configuration, asked.segments, asked.world, asked.agent)
    partial = _partial(asked.json)
    jobs = trials(setting, range(asked.seed, asked.seed + asked.trials))
    if asked.save_weights is not None:
        jobs[0] = Job(setting, asked.seed, keep={'weights'})
    scheduler = make_scheduler(asked.workers, asked.scheduler)
    done = run_with_progress(jobs, scheduler, TrialStore(partial), configuration.scene.task.name)
    packed = done[0].pop('weights', None)
    if asked.save_weights is not None and packed is not None:
        version = int(done[0]['updates_triggered'])
        weights_file.save(asked.save_weights, WeightsUpdate(version, 0, unpack(packed)))
        say(f'weights: {asked.save_weights}')
    report = experiment_document(
        configuration.scene.task.name, configuration.learning, asked.segments,
        asked.seed, asked.world, setting.arm_model, done,
    )
    if asked.json is not None:
        write_document(asked.json, report)
        say(f'figures: {asked.json}')
    if partial is not None:
        partial.unlink(missing_ok=True)
    for line in summary_lines(report):
        say(line)
    return DONE


def _partial(document: Path | None) -> Path | None:
    if document is None or document == STDOUT:
        return None
    return document.with_name(document.name + '.partial')


def summary_lines(report: dict[str, Any]) -> list[str]:
    """Return the summary of an experiment for people."""
    numbers = report['summary']
    names = {
        'laps': 'laps', 'contacts': 'contacts', 'contacts_last_100': 'contacts in the last 100',
        'updates_triggered': 'updates', 'planning_ms': 'planning [ms]', 'update_ms': 'update [ms]',
        'invalid_plans': 'invalid plans', 'wall_s': 'wall time [s]',
    }  # fmt: skip
    heading = f'{len(report["trials"])} trials of {report["segments"]} segments, mean ± sd'
    return [heading] + [
        f'  {text:<26} {numbers[key]["mean"]:.4g} ± {numbers[key]["sd"]:.3g}'
        for key, text in names.items()
        if key in numbers and numbers[key]['mean'] is not None
    ]
