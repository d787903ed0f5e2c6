# SPDX-License-Identifier: Apache-2.0
"""Times one plan and one update: whole, in parts, against NumPy and against a lower bound.

Run: .venv/bin/python bench/kernels.py [--repeats N] [--steps T] [--json FILE] [--out FILE]
                                       [--picture FILE]

Times depend on the machine; the ratios are taken in one run, calls in turn.
"""

import argparse
from collections.abc import Callable
from dataclasses import asdict, replace
import json
from pathlib import Path

from in_numpy import PlainMean, numpy_only
import lower_bound
import numpy as np
from planning_picture import draw
from threadpoolctl import threadpool_limits
from timing import Times, machine, times_ms

from srnn_planner.core import plasticity, plasticity_kernel
from srnn_planner.core.adapter import Learner
from srnn_planner.core.context import ContextPopulation
from srnn_planner.core.decoding import decode, window
from srnn_planner.core.dissonance import experienced
from srnn_planner.core.encoding import draw_history, encode, spike_probability
from srnn_planner.core.parameters import ModelParameters, PlanningParameters
from srnn_planner.core.planner import Goal, PlanRequest, SegmentPlanner, segment_along
from srnn_planner.core.plasticity import Experience
from srnn_planner.core.random_words import seeds
from srnn_planner.core.retreat import at_rest
from srnn_planner.core.sampler import Sampler
from srnn_planner.core.sampling import SampleInput
from srnn_planner.core.selection import select

MODEL = ModelParameters()
HERE, TARGET = np.zeros(2), np.array([0.5, -0.5])
REQUEST = PlanRequest(HERE, at_rest(HERE), TARGET, 0.1)
STOP = 0.5
"""The execution that is learned from stops after this share of the plan."""

Calls = dict[str, Callable[[], object]]


class PlanningCalls:
    """Planning one segment, with what one touch has taught: whole and in parts."""

    def __init__(self, steps: int) -> None:
        """Plan segments of so many steps."""
        planning = PlanningParameters()
        self.planning = replace(planning, sampling=replace(planning.sampling, steps=steps))
        self.planner = SegmentPlanner(MODEL, self.planning, np.random.default_rng(3))
        learner = Learner(MODEL, np.random.default_rng(4))
        learner.learn(*touch(steps))
        self.planner.use_weights(learner.synapses.learned)
        self.rng = np.random.default_rng(5)
        self.goal: Goal = self.planner._goal(TARGET)
        nothing = np.zeros(MODEL.network.neurons)
        self.sampler = Sampler(self.planner.neurons, nothing, planning.context.amplitude)
        self.sampler.use_weights(learner.synapses)
        self.window = window(steps, MODEL.network.tau, planning.sampling.decode_sigma)

    def history(self) -> np.ndarray:
        """Draw what was before the segment."""
        omega = self.planner.neurons.responsibilities(HERE[None])[0]
        return draw_history(
            spike_probability(omega, MODEL.learning), self.planning.sampling.samples,
            MODEL.network.tau, self.rng,
        )  # fmt: skip

    def given(self, context: ContextPopulation) -> SampleInput:
        """Draw all random numbers of the reference."""
        size = (self.planning.sampling.samples, self.planning.sampling.steps)
        return SampleInput(
            self.planner.synapses.dense(), context, np.zeros(MODEL.network.neurons),
            self.history(),
            self.rng.random((*size, MODEL.network.neurons), dtype=np.float32),
            self.rng.random((*size, len(context.weights)), dtype=np.float32),
        )  # fmt: skip

    def calls(self) -> Calls:
        """Return what is timed."""
        history = self.history()
        _, activity = self.sampler.sample(
            self.goal.context, history, seeds(self.rng, len(history))
        )
        paths, _ = decode(activity, self.window)
        cost = self.planner._cost(REQUEST, self.goal)
        average = MODEL.workspace.to_metres(paths[:4].mean(axis=0))
        extent = MODEL.workspace.half_extent
        with numpy_only():
            plain = SegmentPlanner(MODEL, self.planning, np.random.default_rng(3))
            plain._mean = PlainMean(plain.neurons)
            plain.use_weights(self.planner.synapses.learned)

        def in_numpy() -> object:
            with numpy_only():
                return plain.plan(REQUEST)

        work = lower_bound.work(
            MODEL.network, self.given(self.goal.context), self.sampler
        )
        return {
            'plan': lambda: self.planner.plan(REQUEST),
            'goal: ways and context': lambda: self.planner._goal(TARGET),
            'history': self.history,
            # Anew every time: a processor remembers what it has decided before.
            'sampling': lambda: self.sampler.sample(
                self.goal.context, history, seeds(self.rng, len(history))
            ),
            'decoding': lambda: decode(activity, self.window),
            'selection': lambda: select(paths, self.planning.selection, cost),
            'segment': lambda: segment_along(average, REQUEST, self.planning.trajectory, extent),
            'plan in NumPy': in_numpy,
            'sampling in NumPy': lambda: plain._sampler.sample(
                self.goal.context, history, seeds(self.rng, len(history))
            ),
            f'bound: {work.words} random words': lambda: lower_bound.draw(work.words),
            f'bound: {len(work.rows)} rows of weights, {work.steps} looks at potentials': (
                lambda: lower_bound.go_through(self.sampler.synapses, work)
            ),
        }


def touch(steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Return a plan of one segment and an execution that stops halfway [m]."""
    plan = np.linspace([-0.03, 0.0], [0.07, 0.0], steps)
    executed = plan.copy()
    executed[round(STOP * steps) :] = plan[round(STOP * steps)]
    return plan, executed


def update_calls(steps: int) -> Calls:
    """Return learning from one segment: whole, its replay, and the same in NumPy."""
    learner = Learner(MODEL, np.random.default_rng(4))
    mismatch = experienced(MODEL, learner.neurons, *touch(steps))
    experience: Experience = learner._experience(mismatch, learner._signal.rates(mismatch))
    rng, tau, replays = np.random.default_rng(2), MODEL.network.tau, MODEL.learning.replays
    weights = learner.synapses.among(experience.neurons)

    def in_numpy() -> np.ndarray:
        size = experience.executed.shape
        trains = (
            (
                encode(experience.executed, rng.random(size), tau),
                encode(experience.mental, rng.random(size), tau),
            )
            for _ in range(replays)
        )
        return plasticity.replay(weights, experience, trains, tau)

    return {
        'update': lambda: learner.learn(*touch(steps)),
        'replay': lambda: plasticity_kernel.replay(
            weights, experience, seeds(rng, replays), tau
        ),
        'replay in NumPy': in_numpy,
    }


def table(times: dict[str, Times], steps: int) -> str:
    """Return all times and what follows from them, in Markdown."""
    bounds = [t for name, t in times.items() if name.startswith('bound')]
    bound, least = sum(t.p50 for t in bounds), sum(t.least for t in bounds)
    sampling, reference = times['sampling'], times['sampling in NumPy']
    plain = times['plan in NumPy']
    lines = [
        f'{machine()}: 40 samples of {steps} steps, {MODEL.network.neurons} neurons, '
        f'{MODEL.learning.replays} replays.', '',
        '| | p50 | p99 | least |', '|---|---|---|---|',
        *(f'| {name} | {t.p50:.3f} ms | {t.p99:.3f} ms | {t.least:.3f} ms |'
          for name, t in times.items()),
        '',
        f'- Planning is {plain.p50 / times["plan"].p50:.1f} times as fast as in NumPy, '
        f'sampling {reference.p50 / sampling.p50:.1f} times, the replay '
        f'{times["replay in NumPy"].p50 / times["replay"].p50:.0f} times.',
        f'- Sampling takes {sampling.p50 / bound:.1f} times what its random words and its way '
        f'through memory take alone (p50; {sampling.least / least:.1f} times by the least times).',
    ]  # fmt: skip
    return '\n'.join(lines)


def main() -> None:
    """Print the figures, and write them if asked."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--repeats', type=int, default=300, help='timed calls (default 300)')
    parser.add_argument('--steps', type=int, default=40, help='steps of a segment (default 40)')
    parser.add_argument('--json', type=Path, metavar='FILE', help='write the figures as JSON')
    parser.add_argument('--out', type=Path, metavar='FILE', help='write the table')
    parser.add_argument('--picture', type=Path, metavar='FILE', help='where it is drawn')
    options = parser.parse_args()
    calls = {**PlanningCalls(options.steps).calls(), **update_calls(options.steps)}
    with threadpool_limits(1):
        measured = times_ms(*calls.values(), repeats=options.repeats)
    times = dict(zip(calls, measured, strict=True))
    text = table(times, options.steps)
    print(text)
    if options.out:
        options.out.write_text(text + '\n', encoding='utf-8')
    if options.picture:
        draw(times, options.picture)
    if options.json:
        figures = {name: asdict(t) for name, t in times.items()}
        options.json.write_text(json.dumps(figures, indent=2) + '\n', encoding='utf-8')


if __name__ == '__main__':
    main()
