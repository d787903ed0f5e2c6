# SPDX-License-Identifier: Apache-2.0
"""How the networks of two and of three dimensions move, and what they learn of a ball.

Run: .venv/bin/python bench/three_dimensions.py [--trials N] [--side N] [--seed N] [--out FILE]

Trials of 50 plans, each with way points and a ball of its own. A trial has learned if the way
point behind the ball was reached three times at least, and at most one of the last third of
the segments touched.
"""

import argparse
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from ball_world import BallScene, Trial, random_scene, run
import numpy as np
from scale_run import Movement, movement
from scale_setting import VELOCITY, Case, Setting, setting

from srnn_planner.core.planner import PlanRequest, SegmentPlanner
from srnn_planner.core.retreat import at_rest

SEGMENTS = 50
BEHIND, LATE = 3, 1


def with_signal(given: Setting, signal: str) -> Setting:
    """Return a setting with another learning signal."""
    learning = replace(given.model.learning, signal=signal)
    return replace(given, model=replace(given.model, learning=learning))


def movements(given: Setting, scenes: list[BallScene], seed: int) -> list[Movement]:
    """Plan from each way point of each scene to the next, with nothing learned."""
    planner = SegmentPlanner(given.model, given.planning, np.random.default_rng([seed, 0]))
    found = []
    for scene in scenes:
        targets = np.roll(scene.waypoints, -1, axis=0)
        for here, target in zip(scene.waypoints, targets, strict=True):
            units = given.model.workspace.to_units(target)
            request = PlanRequest(here, at_rest(here), units, VELOCITY)
            found.append(movement(given, request, planner.plan(request)))
    return found


def learned(trial: Trial) -> bool:
    """Tell whether a trial has learned of the ball."""
    late = sum(number >= 2 * SEGMENTS // 3 for number in trial.touched)
    return trial.behind >= BEHIND and late <= LATE


def rows(side: int, trials: int, seed: int) -> Iterator[str]:
    """Yield the lines of both tables."""
    yield '| dimensions | spikes | least, most | valid | least of a plan | pace | least |'
    yield f'|{"---|" * 7}'
    settings = {d: setting(Case(d, side)) for d in (2, 3)}
    scenes = {
        d: [random_scene(d, given.model.workspace.half_extent, seed + n) for n in range(trials)]
        for d, given in settings.items()
    }
    for d, given in settings.items():
        spikes, valid, pace = np.array(movements(given, scenes[d], seed)).T
        spikes /= given.planning.sampling.samples
        yield (
            f'| {d} | {spikes.mean():.0f} | {spikes.min():.0f}, {spikes.max():.0f} | '
            f'{valid.mean():.1%} | {valid.min():.0%} | {pace.mean():.2f} | {pace.min():.2f} |'
        )
    yield ''
    yield (
        '| dimensions | signal | learned | reached | behind the ball | touches | updates | '
        'invalid plans | covered |'
    )
    yield f'|{"---|" * 9}'
    for d, given in settings.items():
        for signal in (given.model.learning.signal, 'none'):
            one = with_signal(given, signal)
            done = [run(one, s, SEGMENTS, seed + n) for n, s in enumerate(scenes[d])]
            covered = 1e3 * np.mean(np.concatenate([t.covered for t in done]))
            counts = np.mean(
                [(t.reached, t.behind, len(t.touched), t.updates, t.invalid) for t in done], axis=0
            )
            cells = ' | '.join(f'{count:.1f}' for count in counts)
            good = sum(map(learned, done))
            yield f'| {d} | {signal} | {good} of {trials} | {cells} | {covered:.0f} mm |'


def main() -> None:
    """Print the tables, and write them if asked."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--trials', type=int, default=40, help='of each row, default: 40')
    parser.add_argument('--side', type=int, default=11, help='neurons a side, default: 11')
    parser.add_argument('--seed', type=int, default=0, help='of the first trial, default: 0')
    parser.add_argument('--out', type=Path, metavar='FILE', help='where the tables are written')
    choice = parser.parse_args()
    lines = []
    for line in rows(choice.side, choice.trials, choice.seed):
        print(line, flush=True)
        lines.append(line)
    if choice.out:
        choice.out.write_text('\n'.join(lines) + '\n', encoding='utf-8')


if __name__ == '__main__':
    main()
