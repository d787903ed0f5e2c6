# SPDX-License-Identifier: Apache-2.0
"""How the networks of two and of three dimensions move, and what they learn of a ball.

Run: .venv/bin/python bench/three_dimensions.py [--trials N] [--side N] [--seed N] [--out FILE]

Trials of 50 plans, each with way points and a ball of its own. A trial has learned if the way
point behind the ball was reached three times at least, and at most one of the last third of
the segments touched. Rows with the name of a parameter have the value of two dimensions there.
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


def undone(given: Setting, like: Setting) -> Iterator[tuple[str, Setting]]:
    """Yield each parameter that differs from another network, and a setting with that one."""
    for part in ('network', 'learning'):
        mine, other = getattr(given.model, part), getattr(like.model, part)
        for name, value in vars(other).items():
            if name != 'dimensions' and value != getattr(mine, name):
                changed = replace(mine, **{name: value})
                yield f'`{name}` {value:g}', replace(
                    given, model=replace(given.model, **{part: changed})
                )


def row(name: str, given: Setting, scenes: list[BallScene], seed: int) -> str:
    """Return the line of a setting: how it moves, and what comes of its trials."""
    spikes, valid, pace = np.array(movements(given, scenes, seed)).T
    spikes /= given.planning.sampling.samples
    done = [run(given, scene, SEGMENTS, seed + n) for n, scene in enumerate(scenes)]
    covered = 1e3 * np.mean(np.concatenate([trial.covered for trial in done]))
    behind, touches = np.mean([(t.behind, len(t.touched)) for t in done], axis=0)
    return (
        f'| {name} | {spikes.mean():.0f} ({spikes.min():.0f} to {spikes.max():.0f}) | '
        f'{valid.mean():.1%} ({valid.min():.0%}) | {pace.mean():.1f} ({pace.min():.1f}) | '
        f'{sum(map(learned, done))} of {len(done)} | {behind:.1f} | {touches:.1f} | '
        f'{covered:.0f} mm |'
    )


def rows(side: int, trials: int, seed: int) -> Iterator[str]:
    """Yield the lines of the table."""
    yield '| network | spikes | valid | pace | learned | behind the ball | touches | covered |'
    yield f'|{"---|" * 8}'
    plane, space = (setting(Case(d, side)) for d in (2, 3))
    cases = [
        ('2-D', plane), ('2-D, nothing learned', with_signal(plane, 'none')),
        ('3-D', space), ('3-D, nothing learned', with_signal(space, 'none')),
        *((f'3-D, {name}', one) for name, one in undone(space, plane)),
    ]  # fmt: skip
    for name, given in cases:
        d, extent = given.model.network.dimensions, given.model.workspace.half_extent
        scenes = [random_scene(d, extent, seed + n) for n in range(trials)]
        yield row(name, given, scenes, seed)


def main() -> None:
    """Print the table, and write them if asked."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--trials', type=int, default=40, help='of each row, default: 40')
    parser.add_argument('--side', type=int, default=11, help='neurons a side, default: 11')
    parser.add_argument('--seed', type=int, default=0, help='of the first trial, default: 0')
    parser.add_argument('--out', type=Path, metavar='FILE', help='where the table is written')
    choice = parser.parse_args()
    lines = []
    for line in rows(choice.side, choice.trials, choice.seed):
        print(line, flush=True)
        lines.append(line)
    if choice.out:
        choice.out.write_text('\n'.join(lines) + '\n', encoding='utf-8')


if __name__ == '__main__':
    main()
