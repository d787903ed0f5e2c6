# SPDX-License-Identifier: Apache-2.0
"""Compares the compiled kernels with their NumPy references, and times whole steps.

Run: .venv/bin/python bench/kernels.py [--json FILE]

Times depend on the machine; the ratios are taken in one run, calls in turn.
"""

import argparse
from collections.abc import Callable
import json
from pathlib import Path
import time

import numpy as np

from srnn_planner.core import plasticity, plasticity_kernel
from srnn_planner.core.adapter import Learner
from srnn_planner.core.context import draw_centres, way_point_population
from srnn_planner.core.encoding import draw_history, spike_probability
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.plasticity import Experience
from srnn_planner.core.retreat import at_rest
from srnn_planner.core.sampling import SampleInput, sample_spikes, thin
from srnn_planner.core.sampling_kernel import sample_activity

MODEL, PLANNING = ModelParameters(), PlanningParameters()
TARGET = np.array([0.5, -0.5])


def times_ms(*calls: Callable[[], object], repeats: int) -> list[dict[str, float]]:
    """Time several calls in turn, so that all of them see the same machine."""
    spent: list[list[float]] = [[] for _ in calls]
    for call in calls:
        call()
    for _ in range(repeats):
        for call, row in zip(calls, spent, strict=True):
            began = time.perf_counter()
            call()
            row.append(1e3 * (time.perf_counter() - began))
    return [
        {
            'mean': float(np.mean(row)),
            'sd': float(np.std(row)),
            'p50': float(np.percentile(row, 50)),
            'p99': float(np.percentile(row, 99)),
        }
        for row in spent
    ]


def sampling_calls() -> tuple[Callable[[], object], Callable[[], object]]:
    """Return kernel and reference of the sampler on the same input."""
    rng = np.random.default_rng(1)
    planner = SegmentPlanner(MODEL, PLANNING, rng)
    neurons, network, sampling = planner.neurons, MODEL.network, PLANNING.sampling
    context = way_point_population(
        draw_centres(TARGET, PLANNING.context, rng),
        neurons.positions, sampling.steps, PLANNING.context,
    )
    start = spike_probability(neurons.responsibilities(np.zeros((1, 2)))[0], MODEL.learning)
    size = (sampling.samples, sampling.steps)
    given = SampleInput(
        neurons.prior_weights,
        context,
        np.zeros(network.neurons),
        draw_history(start, sampling.samples, network.tau, rng),
        thin(
            rng.random((*size, network.neurons), dtype=np.float32), network.spike_probability_max
        ),
        rng.random((*size, PLANNING.context.neurons), dtype=np.float32),
    )
    return (
        lambda: sample_activity(network, neurons.positions, given),
        lambda: sample_spikes(network, given),
    )


def touch() -> tuple[np.ndarray, np.ndarray]:
    """Return a plan of one segment and an execution that stops halfway [m]."""
    plan = np.linspace([-0.03, 0.0], [0.07, 0.0], PLANNING.sampling.steps)
    executed = plan.copy()
    executed[len(plan) // 2 :] = plan[len(plan) // 2]
    return plan, executed


def replay_calls() -> tuple[Callable[[], object], Callable[[], object]]:
    """Return kernel and reference of the replay on the same experience."""
    rng = np.random.default_rng(2)
    learner = Learner(MODEL, rng)
    plan, executed = (path / MODEL.workspace.half_extent for path in touch())
    mental_omega, executed_omega = map(learner.neurons.responsibilities, (plan, executed))
    experience = Experience(
        spike_probability(executed_omega, MODEL.learning),
        spike_probability(mental_omega, MODEL.learning),
        3.0 * (mental_omega - executed_omega) ** 2,
    )
    size = (MODEL.learning.replays, 2, *mental_omega.shape)
    uniforms = rng.random(size, dtype=np.float32)
    arguments = (learner.weights, experience, uniforms, MODEL.network.tau)
    return (
        lambda: plasticity_kernel.replay(*arguments),
        lambda: plasticity.replay(*arguments),
    )


def measure(repeats: int) -> dict[str, object]:
    """Return the figures of one run."""
    planner = SegmentPlanner(MODEL, PLANNING, np.random.default_rng(3))
    learner = Learner(MODEL, np.random.default_rng(4))
    request = PlanRequest(np.zeros(2), at_rest(np.zeros(2)), TARGET, 0.1)
    planning, update = times_ms(
        lambda: planner.plan(request), lambda: learner.learn(*touch()), repeats=repeats
    )
    kernel, reference = times_ms(*sampling_calls(), repeats=max(5, repeats // 5))
    fast, slow = times_ms(*replay_calls(), repeats=max(5, repeats // 5))
    return {
        'planning_ms': planning,
        'update_ms': update,
        'sampling_kernel_ms': kernel,
        'sampling_numpy_ms': reference,
        'planning_ratio_vs_numpy': reference['p50'] / kernel['p50'],
        'replay_kernel_ms': fast,
        'replay_numpy_ms': slow,
        'update_ratio_vs_numpy': slow['p50'] / fast['p50'],
    }


def main() -> None:
    """Print the figures, and write them as JSON if asked."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--repeats', type=int, default=100, help='timed calls (default 100)')
    parser.add_argument('--json', type=Path, metavar='FILE', help='write the figures as JSON')
    arguments = parser.parse_args()
    figures = measure(arguments.repeats)
    for name, value in figures.items():
        text = f'{value:.1f}' if isinstance(value, float) else json.dumps(
            {k: round(v, 2) for k, v in value.items()}
        )
        print(f'{name:26} {text}')
    if arguments.json:
        arguments.json.write_text(json.dumps(figures, indent=2) + '\n', encoding='utf-8')


if __name__ == '__main__':
    main()
