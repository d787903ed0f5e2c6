# SPDX-License-Identifier: Apache-2.0
"""The network in NEST (Gewaltig and Diesmann 2007), of neurons `pp_psc_delta`.

These spike with probability 1 - exp(-exp(beta u - c)) in a step: that of the task as long
as it is small, and without its limit, for which the model has no parameter.
"""

import os
from time import perf_counter
from typing import Any

# Or the import writes a banner to the standard output.
os.environ.setdefault('PYNEST_QUIET', '1')

import nest
import numpy as np
from numpy.typing import NDArray

from srnn_bench.network_task import NetworkRun, NetworkTask
from srnn_bench.one_after_another import OneAfterAnother

_CERTAIN = 1e30
"""Rate at which a neuron spikes at once, whatever its potential [Hz]."""

_NO_LEAK = 1e12
"""Membrane time constant [ms] in whose place the task has none."""


class NestNetwork:
    """Built once; simulated time goes on from run to run, one step being 1 ms.

    Between runs nobody spikes, until all potentials have ended. Then the history is played
    back: those of whom it says so are made to spike. What the context neurons do is drawn
    beforehand, and put in by generators: they depend on nothing in the network.
    """

    def __init__(self, task: NetworkTask) -> None:
        """Build neurons and synapses, on one thread."""
        self._task = task
        nest.ResetKernel()
        nest.verbosity = nest.VerbosityLevel.ERROR
        nest.SetKernelStatus({'resolution': 1.0, 'local_num_threads': 1, 'print_time': False})
        network, copies = task.network, task.samples
        self._count = len(task.positions)
        self._neurons = nest.Create('pp_psc_delta', copies * self._count, {
            'tau_m': _NO_LEAK, 'V_m': 0.0, 'with_reset': False,
            'dead_time': float(network.tau), 'dead_time_random': False,
            'c_1': 0.0, 'c_2': 0.0, 'c_3': network.slope,
        })  # fmt: skip
        self._generators = nest.Create('spike_generator', copies * len(task.context.weights))
        self._recorder = nest.Create('spike_recorder')
        for copy in range(copies):
            neurons = self._part(self._neurons, copy, self._count)
            for sign, delay in ((1.0, 1.0), (-1.0, 1.0 + network.tau)):
                _connect(neurons, neurons, sign * task.weights, delay)
            generators = self._part(self._generators, copy, len(task.context.weights))
            _connect(generators, neurons, task.context.weights, 1.0)
        nest.Connect(self._neurons, self._recorder)

    def run(self, seed: int) -> NetworkRun:
        """Run all samples; only the T steps count."""
        task, rng = self._task, np.random.default_rng(seed)
        nest.SetKernelStatus({'rng_seed': seed + 1})
        tau = task.network.tau
        self._neurons.c_2 = 0.0
        nest.Simulate(tau + 2.0)
        self._neurons.V_m = 0.0
        self._play(task.history(rng))
        start = round(nest.biological_time)
        self._pull(start, rng)
        self._neurons.c_2 = 1e3 * np.exp(-task.network.threshold)
        self._recorder.n_events = 0
        nest.Prepare()
        began = perf_counter()
        nest.Run(float(task.steps))
        seconds = perf_counter() - began
        nest.Cleanup()
        return NetworkRun(seconds, self._spikes(start))

    def _play(self, history: NDArray[np.int32]) -> None:
        """Have neurons spike where a history (S, K) says so, and no other."""
        for step in range(-self._task.network.tau, 0):
            who = np.flatnonzero(history.ravel() == step)
            if len(who):
                self._neurons[who.tolist()].c_2 = _CERTAIN
            nest.Simulate(1.0)
            if len(who):
                self._neurons[who.tolist()].c_2 = 0.0

    def _pull(self, start: int, rng: np.random.Generator) -> None:
        """Draw when the potential of each context neuron begins and ends, and put it in."""
        context, tau, steps = self._task.context, self._task.network.tau, self._task.steps
        fired = rng.random((len(self._generators), steps)) < context.spike_probability
        padded = np.pad(fired, ((0, 0), (tau, tau)))
        active = np.lib.stride_tricks.sliding_window_view(padded, tau, axis=1).any(axis=2)
        change = np.diff(active.astype(np.int64), axis=1)
        trains = []
        for row in change:
            (at,) = np.nonzero(row)
            trains.append({'spike_times': start + 1.0 + at, 'spike_weights': 1.0 * row[at]})
        self._generators.set(trains)

    def _spikes(self, start: int) -> NDArray[np.int64]:
        """Count what was recorded from a time on, as (T, K)."""
        events = self._recorder.events
        steps = np.rint(events['times']).astype(np.int64) - start - 1
        neurons = (events['senders'] - self._neurons[0].global_id) % self._count
        within = steps >= 0
        spikes = np.zeros((self._task.steps, self._count), dtype=np.int64)
        np.add.at(spikes, (steps[within], neurons[within]), 1)
        return spikes

    @staticmethod
    def _part(nodes: Any, number: int, size: int) -> Any:
        return nodes[number * size : (number + 1) * size]


class NestOneAfterAnother(OneAfterAnother):
    """A network of one sample, run for each after the last one has died away."""

    def __init__(self, task: NetworkTask) -> None:
        """Build the network of one sample."""
        super().__init__(NestNetwork(task.one_sample()), task.samples)


def _connect(pre: Any, post: Any, weights: NDArray[np.floating], delay: float) -> None:
    """Connect all to all by weights (pre, post), with a delay [ms]."""
    nest.Connect(
        pre, post, 'all_to_all', {'weight': weights.T.astype(np.float64), 'delay': delay}
    )  # fmt: skip
