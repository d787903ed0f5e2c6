# SPDX-License-Identifier: Apache-2.0
"""The network in Brian2, step by step out of Python: targets `numpy` and `cython`."""

from time import perf_counter

import brian2 as b2
from brian2 import ms
import numpy as np

from srnn_bench.brian2_model import build, counts, forced
from srnn_bench.network_task import NetworkRun, NetworkTask
from srnn_bench.one_after_another import OneAfterAnother


class Brian2Network:
    """Built once, and set back before each run."""

    def __init__(self, task: NetworkTask, target: str) -> None:
        """Build the network for a target of Brian2's code generation."""
        b2.prefs.codegen.target = target
        self._task = task
        self._model = build(task)
        self._began: list[float] = []
        self._ended: list[float] = []
        # Functions that take no time as their argument: its unit would cost as much as a step.
        self._model.network.add(
            b2.NetworkOperation(
                lambda: self._began.append(perf_counter()), when='start', order=-1
            ),
            b2.NetworkOperation(lambda: self._ended.append(perf_counter()), when='end', order=1),
        )  # fmt: skip
        self._model.network.store()

    def run(self, seed: int) -> NetworkRun:
        """Run all samples; only the T steps count, not what Brian2 does before the first."""
        task, model = self._task, self._model
        self._began.clear()
        self._ended.clear()
        model.network.restore()
        b2.seed(seed)
        model.neurons.forced = forced(task, np.random.default_rng(seed))
        model.network.run((task.network.tau + task.steps) * ms)
        steps = np.rint(model.spikes.t / ms).astype(np.int64)
        seconds = self._ended[-1] - self._began[task.network.tau]
        return NetworkRun(seconds, counts(task, steps, model.spikes.i))


class Brian2OneAfterAnother(OneAfterAnother):
    """A network of one sample, set back and run for each."""

    def __init__(self, task: NetworkTask, target: str) -> None:
        """Build the network of one sample."""
        super().__init__(Brian2Network(task.one_sample(), target), task.samples)
