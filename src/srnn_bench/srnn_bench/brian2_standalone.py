# SPDX-License-Identifier: Apache-2.0
"""The network in Brian2 as a C++ program of its own: target `cpp_standalone`."""

from tempfile import TemporaryDirectory

import brian2 as b2
from brian2 import ms
import numpy as np

from srnn_bench.brian2_model import build, counts, forced
from srnn_bench.network_task import NetworkRun, NetworkTask
from srnn_bench.one_after_another import OneAfterAnother


class Brian2Standalone:
    """Compiled once; a process of its own for each run."""

    def __init__(self, task: NetworkTask) -> None:
        """Build and compile."""
        self._task = task
        self._directory = TemporaryDirectory(prefix='srnn_bench_')
        b2.set_device('cpp_standalone', build_on_run=False, directory=self._directory.name)
        self._model = build(task)
        # The history is a run of its own: the program says how long its last one took.
        self._model.network.run(task.network.tau * ms)
        self._model.network.run(task.steps * ms)
        b2.device.build(run=False, directory=self._directory.name)

    def run(self, seed: int) -> NetworkRun:
        """Run all samples; only the T steps count, not start and building of synapses.

        Random numbers of the simulation are those of the program, which takes no seed anew.
        """
        task, model = self._task, self._model
        b2.device.run(
            run_args={model.neurons.forced: forced(task, np.random.default_rng(seed))}
        )  # fmt: skip
        steps = np.rint(model.spikes.t / ms).astype(np.int64)
        return NetworkRun(float(b2.device._last_run_time), counts(task, steps, model.spikes.i))


class Brian2StandaloneOneAfterAnother(OneAfterAnother):
    """A program for one sample, started for each."""

    def __init__(self, task: NetworkTask) -> None:
        """Build and compile the program."""
        super().__init__(Brian2Standalone(task.one_sample()), task.samples)
