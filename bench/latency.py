# SPDX-License-Identifier: Apache-2.0
"""How long the graph takes: from joint state to command, from touch to stop, to a new plan.

Run: .venv/bin/python bench/latency.py [--runs N] [--segments N] [--json FILE] [--out FILE]

Recorded runs of `srnn demo` in the standard scene, each with another seed and nothing learned
before: quiet and with an endless loop on every processor, with real-time priority and without.
The exit code is 1 if a goal is missed on a quiet machine with real-time priority, or if a run
fails in any case.
"""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
import json
import os
from pathlib import Path
import sys
import tempfile
from typing import Any

from latency_run import (
    ALL_ACTIVE,
    FIRST_COMMAND,
    FIRST_SEGMENT,
    SHARE,
    Measured,
    RunFailedError,
    run,
)
import numpy as np
from numpy.typing import NDArray

from srnn_bringup.latency import latencies as of
from srnn_bringup.page.timings import LEARNING, PERCENTILES, PLANNING, spread
from srnn_node.realtime import VARIABLE

sys.path.insert(0, str(Path(__file__).parents[1] / 'test'))
from busy_loops import busy_loops

ROWS = (
    of.ANSWER, of.STOP, of.STOP_BOUNDED, of.SHOWN, of.STOPPED, of.STILL,
    of.ADAPTED, of.SHARED, of.BEGUN, of.SENT,
    PLANNING, LEARNING, SHARE, ALL_ACTIVE, FIRST_COMMAND, FIRST_SEGMENT,
)  # fmt: skip
GOALS = {of.STOP_BOUNDED: ('longest', 75.0), of.ADAPTED: ('p95', 60.0), SHARE: ('longest', 0.01)}
"""Largest value of a percentile, [ms] or a share; the first one is that of `docs/faults.md`."""

COLD = 'nothing compiled'
CACHE = 'NUMBA_CACHE_DIR'


@dataclass
class Condition:
    """How the machine is when the graph runs, and what was measured."""

    priority: bool
    busy: bool
    runs: list[Measured] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)

    @property
    def words(self) -> tuple[str, str]:
        """Return priority and machine, as `docs/fri_timing.md` calls them."""
        return 'SCHED_FIFO' if self.priority else 'none', 'busy' if self.busy else 'quiet'

    def samples(self, name: str) -> NDArray[np.float64]:
        """Return samples (n,) of all runs, [ms] or a share."""
        return np.concatenate([np.empty(0), *(r.figures.get(name, []) for r in self.runs)])

    def environment(self) -> dict[str, str]:
        """Return the environment of the graph."""
        return {**os.environ, VARIABLE: '' if self.priority else '0'}


def measure(condition: Condition, runs: int, segments: int) -> None:
    """Run the demo with the seeds 0, 1, ... under a condition."""
    with busy_loops((os.cpu_count() or 1) if condition.busy else 0):
        for seed in range(runs):
            with tempfile.TemporaryDirectory() as folder:
                try:
                    one = run(Path(folder), segments, seed, condition.environment())
                except RunFailedError as error:
                    condition.failures.append(str(error))
                else:
                    condition.runs.append(one)
            print(f'{", ".join(condition.words)}: {seed + 1} of {runs} runs', file=sys.stderr)


def first_start() -> Measured:
    """Start the graph with no kernel compiled yet."""
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as cache:
        return run(Path(folder), segments=1, seed=0, environ={**os.environ, CACHE: cache})


def table(conditions: Sequence[Condition]) -> Iterator[str]:
    """Yield the lines of the table."""
    yield f'| what | priority | machine | count | {" | ".join(PERCENTILES)} | goal |'
    yield f'|---|---|---|---|{"---|" * len(PERCENTILES)}---|'
    for name in ROWS:
        key, limit = GOALS.get(name, ('', 0.0))
        goal = f'{key} at most {_words(name, limit)}' if key else ''
        for condition in conditions:
            samples = condition.samples(name)
            values = [_words(name, value) for value in spread(samples)] if len(samples) else []
            cells = values or [''] * len(PERCENTILES)
            row = (name, *condition.words, str(len(samples)), *cells, goal)
            yield f'| {" | ".join(row)} |'


def report(conditions: Sequence[Condition], cold: Measured, choice: argparse.Namespace) -> str:
    """Return the page with the table."""
    unanswered = '; '.join(
        f'{", ".join(c.words)}: {sum(r.unanswered for r in c.runs)} of '
        f'{sum(r.joint_states for r in c.runs)}' for c in conditions
    )  # fmt: skip
    starts = ', '.join(
        f'{name.removeprefix("from the command line ")} {1e-3 * cold.figures[name][0]:.1f} s'
        for name in (ALL_ACTIVE, FIRST_COMMAND, FIRST_SEGMENT)
    )
    failures = [failure for c in conditions for failure in c.failures]
    return '\n'.join([
        '# How long the graph takes', '',
        f'`bench/latency.py --runs {choice.runs} --segments {choice.segments}`, '
        f'{os.cpu_count()} processors: `srnn demo --record` with as many seeds in each',
        'condition. "Busy" is one endless loop per processor beside it. Times in ms by the clock',
        'of the system. A joint state counts from its stamp, set before the arm measures; a touch',
        'from the last joint state with the tip clear of all obstacles, up to a cycle of 4 ms too',
        'early; the command line from its start. All else counts from and to the moment in which',
        'the middleware is handed a message: the way of a command to the arm is left out.', '',
        *table(conditions), '',
        f'Joint states without a command of their own: {unanswered}.', '',
        f'With {COLD}: {starts}.', '',
        *(f'Failed: {failure}' for failure in failures),
    ]).rstrip() + '\n'  # fmt: skip


def document(conditions: Sequence[Condition], cold: Measured) -> dict[str, Any]:
    """Return all figures as plain data for JSON; samples in the order of the runs."""
    return {
        'conditions': [
            {
                'priority': c.priority, 'busy': c.busy, 'failures': c.failures,
                'joint_states': sum(r.joint_states for r in c.runs),
                'unanswered': sum(r.unanswered for r in c.runs),
                'percentiles': {
                    name: dict(zip(PERCENTILES, spread(samples), strict=True))
                    for name in ROWS if len(samples := c.samples(name))
                },
                'samples': {
                    name: c.samples(name).tolist() for name in ROWS if name != of.ANSWER
                },
            }
            for c in conditions
        ],
        'nothing_compiled': {
            name: float(cold.figures[name][0])
            for name in (ALL_ACTIVE, FIRST_COMMAND, FIRST_SEGMENT)
        },
    }  # fmt: skip


def missed(condition: Condition) -> list[str]:
    """Return the goals that are missed; one of which nothing was measured is."""
    return [
        name for name, (key, limit) in GOALS.items()
        if not len(samples := condition.samples(name))
        or dict(zip(PERCENTILES, spread(samples), strict=True))[key] > limit
    ]  # fmt: skip


def _words(name: str, value: float) -> str:
    return f'{value:.2%}' if name == SHARE else f'{value:.2f}'


def main() -> int:
    """Measure, and print or write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--runs', type=int, default=10, help='in each condition, default: 10')
    parser.add_argument('--segments', type=int, default=12, help='of each run, default: 12')
    parser.add_argument('--json', type=Path, metavar='FILE', help='where all figures are written')
    parser.add_argument('--out', type=Path, metavar='FILE', help='where the table is written')
    choice = parser.parse_args()
    cold = first_start()
    conditions = [
        Condition(priority, busy) for busy in (False, True) for priority in (True, False)
    ]
    for condition in conditions:
        measure(condition, choice.runs, choice.segments)
    text = report(conditions, cold, choice)
    print(text, end='')
    if choice.out:
        choice.out.write_text(text, encoding='utf-8')
    if choice.json:
        choice.json.write_text(json.dumps(document(conditions, cold), indent=1) + '\n')
    failed = any(condition.failures for condition in conditions)
    return int(failed or bool(missed(conditions[0])))


if __name__ == '__main__':
    raise SystemExit(main())
