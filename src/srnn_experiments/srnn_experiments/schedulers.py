# SPDX-License-Identifier: Apache-2.0
"""Where trials are done: on the cores of this machine, or on a Dask cluster."""

from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
import multiprocessing
import os
from typing import Any

from srnn_experiments.campaign import Job, do
from srnn_experiments.errors import SchedulerError

DASK_TIMEOUT_S = 10.0
RETRIES = 3
"""A trial whose worker is lost is done again this many times."""


class LocalProcesses:
    """One process per worker; with one worker everything is done in this process."""

    def __init__(self, workers: int | None = None) -> None:
        """Use `workers` processes, by default one per core."""
        self._workers = workers or os.cpu_count() or 1

    def map(self, jobs: Sequence[Job]) -> Iterator[tuple[int, dict[str, Any]]]:
        """Yield index and result of every job, in the order in which they end.

        Raises:
            SchedulerError: a worker has died, for example for want of memory.

        """
        if self._workers == 1 or len(jobs) <= 1:
            yield from ((index, do(job)) for index, job in enumerate(jobs))
            return
        # A fork would take over locks and threads of this process.
        context = multiprocessing.get_context('spawn')
        workers = min(self._workers, len(jobs))
        with ProcessPoolExecutor(workers, context) as pool:
            futures = {pool.submit(do, job): index for index, job in enumerate(jobs)}
            try:
                for future in as_completed(futures):
                    yield futures[future], future.result()
            except BrokenProcessPool as error:
                raise SchedulerError(
                    'a worker has died; what was finished is kept: run the same command again'
                ) from error
            finally:
                pool.shutdown(wait=False, cancel_futures=True)


class DaskCluster:
    """The workers of an existing Dask scheduler."""

    def __init__(self, address: str) -> None:
        """Connect to the scheduler at `address`, for example ``tcp://host:8786``.

        Raises:
            SchedulerError: Dask is not installed, or nobody answers there.

        """
        try:
            from distributed import Client
        except ImportError as error:
            raise SchedulerError(
                "--scheduler needs Dask: pip install 'srnn_experiments[dask]'"
            ) from error
        try:
            self._client: Any = Client(address, timeout=DASK_TIMEOUT_S)
        except (OSError, ValueError, TypeError) as error:
            raise SchedulerError(f'no Dask scheduler answers at {address!r}: {error}') from error

    def map(self, jobs: Sequence[Job]) -> Iterator[tuple[int, dict[str, Any]]]:
        """Yield index and result of every job; a lost worker's trials go to another.

        Raises:
            SchedulerError: a trial was lost `RETRIES` times.

        """
        from distributed import KilledWorker
        from distributed import as_completed as dask_completed

        futures = self._client.map(do, jobs, pure=False, retries=RETRIES)
        index_of = {future.key: index for index, future in enumerate(futures)}
        try:
            for future, result in dask_completed(futures, with_results=True):
                yield index_of[future.key], result
        except KilledWorker as error:
            raise SchedulerError(f'workers keep dying: {error}') from error
        finally:
            self._client.cancel(futures)
