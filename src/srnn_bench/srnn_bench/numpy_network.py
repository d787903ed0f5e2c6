# SPDX-License-Identifier: Apache-2.0
"""The network in plain NumPy: the reference of the planner."""

from time import perf_counter

import numpy as np

from srnn_bench.network_task import NetworkRun, NetworkTask
from srnn_planner.core.sampling import SampleInput, sample_spikes


class NumpyNetwork:
    """Draws all random numbers of a run, and runs the reference on them."""

    def __init__(self, task: NetworkTask) -> None:
        """Take the task."""
        self._task = task

    def run(self, seed: int) -> NetworkRun:
        """Run all samples; the random numbers count as part of it."""
        task, rng = self._task, np.random.default_rng(seed)
        size = (task.samples, task.steps)
        began = perf_counter()
        spikes = sample_spikes(
            task.network,
            SampleInput(
                task.weights, task.context, np.zeros(len(task.positions)), task.history(rng),
                rng.random((*size, len(task.positions)), dtype=np.float32),
                rng.random((*size, len(task.context.weights)), dtype=np.float32),
            ),
        )  # fmt: skip
        return NetworkRun(perf_counter() - began, spikes.sum(axis=0))
