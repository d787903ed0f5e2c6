# SPDX-License-Identifier: Apache-2.0
"""What one trial of the transfer experiment showed."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from srnn_experiments.attribution import attribute
from srnn_experiments.figures import LATE
from srnn_experiments.paper import TRANSFER_CONTACTS
from srnn_experiments.setting import Setting
from srnn_experiments.transfer import Transfer, new_obstacles

SLACK = 0.01
"""A contact is with an obstacle if the tool is measured no further away from it [m]."""


@dataclass(frozen=True)
class TargetTrial:
    """A trial in the target world, its contacts told apart.

    Attributes:
        seed: of the trial.
        new: segments that touched a new obstacle.
        old: segments that touched an obstacle of the source world.
        nothing: segments that felt a contact where no obstacle is.
        flaws: why the scene does not count as learned; empty if it does.
        updates: segments that changed the weights.
        laps: rounds of all way points.

    """

    seed: int
    new: tuple[int, ...]
    old: tuple[int, ...]
    nothing: tuple[int, ...]
    flaws: tuple[str, ...]
    updates: int
    laps: int

    @property
    def learned(self) -> bool:
        """Tell whether the scene was learned, see `flaws`."""
        return not self.flaws

    @property
    def few(self) -> bool:
        """Tell whether it was learned with no more contacts than the paper's arm needed."""
        return self.learned and len(self.new) <= TRANSFER_CONTACTS

    @property
    def contacts(self) -> int:
        """Number of contacts with anything."""
        return len(self.new) + len(self.old) + len(self.nothing)

    @property
    def failures(self) -> tuple[str, ...]:
        """Everything that should not have happened, in words."""
        found = list(self.flaws)
        if len(self.new) > TRANSFER_CONTACTS:
            found.append(f'{_contacts(len(self.new))} with the new obstacle')
        if self.old:
            segments = ', '.join(map(str, self.old))
            found.append(f'{_contacts(len(self.old))} with the first one (segment {segments})')
        return tuple(found)


def target_trial(trial: Mapping[str, Any], transfer: Transfer) -> TargetTrial:
    """Return what the figures of a trial in the target world of `transfer` mean."""
    target = transfer.target
    new = new_obstacles(transfer.source.scene, target.scene)
    points = np.array(trial['contact_points_m']).reshape(-1, 2)
    with_whom = attribute(
        points, (transfer.source.scene.obstacles, new), target.mount.tool_radius + SLACK
    )
    segments: dict[int | None, list[int]] = {0: [], 1: [], None: []}
    for number, group in zip(trial['contact_segments'], with_whom, strict=True):
        segments[group].append(number)
    return TargetTrial(
        seed=trial['seed'],
        new=tuple(segments[1]),
        old=tuple(segments[0]),
        nothing=tuple(segments[None]),
        flaws=flaws(trial, target),
        updates=trial['updates_triggered'],
        laps=trial['laps'],
    )


def flaws(trial: Mapping[str, Any], setting: Setting) -> tuple[str, ...]:
    """Return why a trial does not count as learned, in words; nothing if it does."""
    found = []
    if trial['segments_executed'] < setting.segments:
        found.append(f'came to a halt after {trial["segments_executed"]} segments')
    if trial['contacts_last_100']:
        found.append(f'{_contacts(trial["contacts_last_100"])} in the last {LATE} segments')
    if not trial['still_reached']:
        found.append(f'not every way point reached in the last {LATE} segments')
    return tuple(found)


def _contacts(count: int) -> str:
    return f'{count} contact' if count == 1 else f'{count} contacts'
