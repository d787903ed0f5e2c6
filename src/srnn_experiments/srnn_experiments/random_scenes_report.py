# SPDX-License-Identifier: Apache-2.0
"""How the network does on scenes that nobody chose."""

from collections.abc import Mapping, Sequence
from statistics import median
from typing import Any

from srnn_experiments.estimates import share_estimate, share_text

HELD_OUT = 200_000
"""Seeds of scenes from here on were never used to choose a parameter."""


def learned(trial: Mapping[str, Any]) -> bool:
    """Tell whether a trial ends without contact and still reaches every way point."""
    return bool(trial['contacts_last_100'] == 0 and trial['still_reached'])


def report(
    trials: Sequence[Mapping[str, Any]], oracle: Sequence[Mapping[str, Any]]
) -> dict[str, Any]:
    """Return the figures over all scenes.

    Args:
        trials: of the network, one for each scene.
        oracle: of the network that is told of the obstacles, the same scenes.

    Returns:
        Share of scenes that were learned with its 95 % interval, median contacts, median
        efficiency (laps over laps of the oracle; None where the oracle makes no lap), the
        seeds that failed, and a line for every scene.

    """
    scenes = [_scene(t, o) for t, o in zip(trials, oracle, strict=True)]
    count = sum(scene['learned'] for scene in scenes)
    efficiencies = [s['efficiency'] for s in scenes if s['efficiency'] is not None]
    return {
        'learned': share_estimate(count, len(scenes)),
        'contacts_median': median(scene['contacts'] for scene in scenes),
        'efficiency_median': median(efficiencies) if efficiencies else None,
        'invalid_plans': sum(trial['invalid_plans'] for trial in trials),
        'failed_seeds': [scene['seed'] for scene in scenes if not scene['learned']],
        'scenes': scenes,
    }


def as_markdown(found: Mapping[str, Any], title: str) -> str:
    """Return a report as text, failures first."""
    efficiency = found['efficiency_median']
    lines = [
        f'# {title}',
        '',
        f'Learned (no contact in the last 100 segments, every way point still reached): '
        f'{share_text(found["learned"])}; median contacts '
        f'{found["contacts_median"]:g}; median efficiency '
        f'{"–" if efficiency is None else format(efficiency, ".2f")} (laps over laps of the '
        f'oracle); invalid plans {found["invalid_plans"]}.',
        '',
        f'Failed: {", ".join(map(str, found["failed_seeds"])) or "none"}.',
        '',
        '| seed | learned | contacts | in the last 100 | laps | oracle laps | efficiency |',
        '|---|---|---|---|---|---|---|',
    ]
    for scene in sorted(found['scenes'], key=lambda scene: (scene['learned'], scene['seed'])):
        value = scene['efficiency']
        lines.append(
            f'| {scene["seed"]} | {"yes" if scene["learned"] else "no"} | {scene["contacts"]} '
            f'| {scene["contacts_last_100"]} | {scene["laps"]} | {scene["oracle_laps"]} '
            f'| {"–" if value is None else format(value, ".2f")} |'
        )
    return '\n'.join(lines) + '\n'


def _scene(trial: Mapping[str, Any], oracle: Mapping[str, Any]) -> dict[str, Any]:
    best = oracle['laps']
    return {
        'seed': trial['seed'],
        'learned': learned(trial),
        'contacts': trial['contacts'],
        'contacts_last_100': trial['contacts_last_100'],
        'laps': trial['laps'],
        'oracle_laps': best,
        'efficiency': trial['laps'] / best if best else None,
    }
