# SPDX-License-Identifier: Apache-2.0
"""The network in Brian2, step by step out of Python: targets `numpy` and `cython`."""

from time import perf_counter

import brian2 as b2
from brian2 import ms
import numpy as np

from srnn_bench.brian2_model import build, counts, forced
from srnn_bench.network_task import NetworkRun, NetworkTask


class Brian2Network:
    """Built once, and set back before each run."""

    def __init__(self, task: NetworkTask, target: str) -> None:
        """Build the network for a target of Brian2's code generation."""
        b2.prefs.codegen.target = target
        self._task = task
        self._model = build(task)
        self._began = self._ended = 0.0
        tau, last = task.network.tau, task.network.tau + task.steps - 1

        def begin(t: b2.Quantity) -> None:
            if round(t / ms) == tau:
                self._began = perf_counter()

        def end(t: b2.Quantity) -> None:
            if round(t / ms) == last:
                self._ended = perf_counter()

        self._model.network.add(
            b2.NetworkOperation(begin, when='start', order=-1),
            b2.NetworkOperation(end, when='end', order=1),
        )
        self._model.network.store()

    def run(self, seed: int) -> NetworkRun:
        """Run all samples; only the T steps count, not what Brian2 does before the first."""
        task, model = self._task, self._model
        model.network.restore()
        b2.seed(seed)
        model.neurons.forced = forced(task, np.random.default_rng(seed))
        model.network.run((task.network.tau + task.steps) * ms)
        steps = np.rint(model.spikes.t / ms).astype(np.int64)
        return NetworkRun(self._ended - self._began, counts(task, steps, model.spikes.i))
