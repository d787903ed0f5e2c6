# SPDX-License-Identifier: Apache-2.0
"""Many trials: each done once, wherever there is a worker, and remembered."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import Any, Protocol

from threadpoolctl import threadpool_limits

from srnn_experiments.keepsakes import KEEPSAKES, NOTHING
from srnn_experiments.setting import Setting
from srnn_experiments.store import Key, TrialStore
from srnn_experiments.trial import Outcome, run_trial


@dataclass(frozen=True, eq=False)
class Job:
    """One trial to do.

    Attributes:
        setting: what is tried.
        seed: of all random numbers.
        keep: what is wanted besides its figures, names of `KEEPSAKES`.

    """

    setting: Setting
    seed: int
    keep: Set[str] = NOTHING

    @property
    def key(self) -> Key:
        """What this job is known by."""
        return '+'.join([self.setting.digest(), *sorted(self.keep)]), self.seed


class Scheduler(Protocol):
    """Does jobs somewhere."""

    def map(self, jobs: Sequence[Job]) -> Iterator[tuple[int, dict[str, Any]]]:
        """Yield index and result of every job, in the order in which they end."""


def outcome_of(job: Job) -> Outcome:
    """Do one trial; its decisions are the same wherever it is done."""
    # Sums of a matrix product depend on the number of threads, decisions must not.
    with threadpool_limits(1):
        return run_trial(job.setting, job.seed)


def do(job: Job) -> dict[str, Any]:
    """Return the figures of one trial, and what is to be kept; this is what a worker runs."""
    outcome = outcome_of(job)
    kept = {name: KEEPSAKES[name](job.setting, outcome) for name in sorted(job.keep)}
    return outcome.figures | {name: value for name, value in kept.items() if value is not None}


def run_jobs(
    jobs: Sequence[Job],
    scheduler: Scheduler,
    store: TrialStore,
    say_done: Callable[[int], None] = lambda count: None,
) -> list[dict[str, Any]]:
    """Return the results of jobs in their order; what the store has is not done again.

    Args:
        jobs: what to do.
        scheduler: where to do it.
        store: what is done already, and where to put what is done now.
        say_done: told how many more trials are done.

    """
    missing = list({job.key: job for job in jobs if job.key not in store}.values())
    say_done(len(jobs) - len(missing))
    for index, trial in scheduler.map(missing):
        store.add(missing[index].key, trial)
        say_done(1)
    return [store[job.key] for job in jobs]


def trials(setting: Setting, seeds: Iterable[int], keep: Set[str] = NOTHING) -> list[Job]:
    """Return a job for every seed."""
    return [Job(setting, seed, keep) for seed in seeds]


def rows(settings: Mapping[str, Setting], seeds: Sequence[int]) -> list[Job]:
    """Return jobs for every setting and seed, all settings of a seed together."""
    return [Job(setting, seed) for seed in seeds for setting in settings.values()]
