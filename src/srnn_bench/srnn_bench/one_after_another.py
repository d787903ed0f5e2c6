# SPDX-License-Identifier: Apache-2.0
"""The plain way to draw samples: one network, run sample after sample."""

import numpy as np

from srnn_bench.network_task import NetworkRun, NetworkRunner


class OneAfterAnother:
    """Runs a network of one sample as often as there are samples."""

    def __init__(self, runner: NetworkRunner, samples: int) -> None:
        """Take who runs one sample, and how many there are."""
        self._runner, self._samples = runner, samples

    def run(self, seed: int) -> NetworkRun:
        """Run all samples, each with a seed of its own, and add up times and spikes."""
        # Every simulator takes seeds of 31 bits.
        seeds = np.random.SeedSequence(seed).generate_state(self._samples) >> 1
        runs = [self._runner.run(int(number)) for number in seeds]
        return NetworkRun(
            sum(run.seconds for run in runs), np.sum([run.spikes for run in runs], axis=0)
        )  # fmt: skip
