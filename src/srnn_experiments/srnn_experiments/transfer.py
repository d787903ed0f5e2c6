# SPDX-License-Identifier: Apache-2.0
"""The transfer experiment: weights learned in one world go on learning in another."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from srnn_config.scene import Obstacle, Scene
from srnn_experiments.campaign import Job
from srnn_experiments.errors import SceneError
from srnn_experiments.setting import Setting
from srnn_msgs_py.weights import LearnedWeights

MASS_SCALE, PAYLOAD = 1.2, 0.5
"""Links over their nominal mass, and what the tool weighs beyond it [kg], of the heavier arm."""

ROUGHER = 5.0
"""Dry friction of the rougher joints over that of the arm."""

DELAY = 0.012
"""How late delayed commands arrive [s]; with 0.02 s free motion already feels like contact."""


@dataclass(frozen=True, eq=False)
class Transfer:
    """From which world to which: one row of the table.

    Attributes:
        change: what is different in the target world, in words.
        source: where the first obstacles are learned, from the prior weights.
        target: where the new ones stand as well; without weights, as if nothing was known.

    """

    change: str
    source: Setting
    target: Setting

    def source_jobs(self, seeds: Sequence[int]) -> list[Job]:
        """Return the trials that learn the first obstacles."""
        return [Job(self.source, seed, keep={'weights'}) for seed in seeds]

    def target_jobs(
        self, seeds: Sequence[int], weights: Sequence[LearnedWeights]
    ) -> list[Job]:
        """Return the trials that start from the weights of each seed."""
        return [
            Job(replace(self.target, weights=learned), seed)
            for seed, learned in zip(seeds, weights, strict=True)
        ]

    def scratch_jobs(self, seeds: Sequence[int]) -> list[Job]:
        """Return the trials that start from nothing in the same world, for comparison."""
        return [Job(self.target, seed) for seed in seeds]


def transfers(base: Setting, target: Scene) -> dict[str, Transfer]:
    """Return the rows of the table by name.

    Args:
        base: network and arm; its scene holds the first obstacles.
        target: scene with the first and the new obstacles.

    Raises:
        SceneError: see `new_obstacles`.

    """
    new_obstacles(base.scene, target)
    point, arm = replace(base, world='point'), replace(base, world='mujoco')
    there = replace(arm, scene=target)
    was, command = base.arm.mismatch, base.arm.command
    heavier = replace(was, mass_scale=MASS_SCALE, payload=PAYLOAD)
    friction = tuple(ROUGHER * value for value in was.friction)
    rougher = replace(was, friction=friction)
    later = replace(command, delay=DELAY)
    return {
        'point to arm': Transfer('a point is replaced by the simulated arm', point, there),
        'heavier arm': Transfer(
            f'links {MASS_SCALE:g} instead of {was.mass_scale:g} times as heavy as the '
            f'controller believes, tool {PAYLOAD:g} instead of {was.payload:g} kg heavier',
            arm, replace(there, arm=replace(base.arm, mismatch=heavier)),
        ),
        'rougher joints': Transfer(
            f'dry friction of the joints {_range(friction)} instead of {_range(was.friction)} Nm',
            arm, replace(there, arm=replace(base.arm, mismatch=rougher)),
        ),
        'delayed commands': Transfer(
            f'commands arrive {1e3 * DELAY:g} instead of {1e3 * command.delay:g} ms late',
            arm, replace(there, arm=replace(base.arm, command=later)),
        ),
    }  # fmt: skip


def new_obstacles(source: Scene, target: Scene) -> tuple[Obstacle, ...]:
    """Return the obstacles that stand in the target scene only.

    Raises:
        SceneError: there are none, or an obstacle of the source scene is not in the target.

    """
    names = f"'{target.task.name}'", f"'{source.task.name}'"
    for index, obstacle in enumerate(source.obstacles):
        if obstacle not in target.obstacles:
            raise SceneError(
                f'scene {names[0]} lacks obstacle {index} of scene {names[1]}; it must have '
                'all of them and at least one more'
            )
    new = tuple(o for o in target.obstacles if o not in source.obstacles)
    if not new:
        raise SceneError(f'scene {names[0]} must have an obstacle that scene {names[1]} has not')
    return new


def _range(values: Sequence[float]) -> str:
    low, high = min(values), max(values)
    return f'{low:g}' if low == high else f'{low:g} to {high:g}'
