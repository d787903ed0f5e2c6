# SPDX-License-Identifier: Apache-2.0
"""The network as the planner runs it: its compiled sampler, alone and within planning."""

from time import perf_counter

import numpy as np

from srnn_bench.network_task import START, TARGET, NetworkRun, NetworkTask
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.random_words import seeds
from srnn_planner.core.retreat import at_rest
from srnn_planner.core.sampler import Sampler
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses

VELOCITY = 0.1
"""Execution speed of the planned segment [m/s]."""


class CompiledSampler:
    """The sampler alone: from the history of the neurons to their spikes."""

    def __init__(self, task: NetworkTask, planning: PlanningParameters) -> None:
        """Give the sampler its weights."""
        self._task = task
        neurons = StateNeurons(task.network)
        bias = np.zeros(len(neurons.positions))
        self._sampler = Sampler(neurons, bias, planning.context.amplitude)
        self._sampler.use_weights(Synapses.of(neurons.prior, task.weights))

    def run(self, seed: int) -> NetworkRun:
        """Draw the history and run all samples."""
        task, rng = self._task, np.random.default_rng(seed)
        began = perf_counter()
        history = task.history(rng)
        spikes, _ = self._sampler.sample(task.context, history, seeds(rng, task.samples))
        return NetworkRun(perf_counter() - began, spikes)


class WholePlanning:
    """`SegmentPlanner.plan`: sampling, decoding, selection, and the segment in time."""

    def __init__(self, model: ModelParameters, planning: PlanningParameters, seed: int) -> None:
        """Build the planner, whose random numbers go on from run to run."""
        self._planner = SegmentPlanner(model, planning, np.random.default_rng(seed))
        start = model.workspace.to_metres(np.array(START))
        # Planned `again`, as else the planner would tire of a place that it never leaves.
        self._request = PlanRequest(
            start, at_rest(start), np.array(TARGET), VELOCITY, again=True
        )  # fmt: skip

    def run(self, _: int) -> NetworkRun:
        """Plan one segment."""
        began = perf_counter()
        plan = self._planner.plan(self._request)
        return NetworkRun(perf_counter() - began, plan.spikes)
