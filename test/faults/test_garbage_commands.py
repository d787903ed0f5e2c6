# SPDX-License-Identifier: Apache-2.0
"""Joint commands that no arm can follow: none gets through, and the arm does not notice them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from arm_rig import PERIOD, Rig
from moving_arm import generator, random_course, speeds
import numpy as np
import pytest

from lwr_description import POSITION_MAX, VELOCITY_MAX
from lwr_guard import Refusal

TICKS = 60
OFFERS = 9
"""Bad commands in a tick: 7 faults x 3 repeats x 60 ticks x 9 are 11 340."""

Random = np.random.Generator


@dataclass(frozen=True)
class Garbage:
    """A way to spoil a joint command (7,) [rad], given the one that was accepted last.

    Attributes:
        row: of the fault matrix, for segments.
        refusal: the reason that must be given.
        spoil: returns the bad command.

    """

    row: int
    refusal: Refusal
    spoil: Callable[[np.ndarray, Random], Any]


def _with(command: np.ndarray, rng: Random, value: float) -> np.ndarray:
    spoiled = command.copy()
    spoiled[rng.choice(7, rng.integers(1, 8), replace=False)] = value
    return spoiled


def _beyond(command: np.ndarray, rng: Random) -> np.ndarray:
    joint = rng.integers(7)
    spoiled = command.copy()
    beyond = POSITION_MAX[joint] * (1.0 + 10.0 ** rng.uniform(-9, 6))
    spoiled[joint] = rng.choice([-1.0, 1.0]) * beyond
    return spoiled


def _far(command: np.ndarray, rng: Random) -> np.ndarray:
    while True:
        step = rng.uniform(-1.0, 1.0, 7) * VELOCITY_MAX
        step *= 10.0 ** rng.uniform(0.001, 2.0) * PERIOD / np.abs(step / VELOCITY_MAX).max()
        if (np.abs(command + step) < POSITION_MAX).all():
            return command + step


def _misshapen(command: np.ndarray, rng: Random) -> Any:
    shapes = (
        command[: rng.integers(7)], np.append(command, 0.0), command[None], command[:, None],
        float(command[0]), [], np.empty((7, 0)),
    )  # fmt: skip
    return shapes[rng.integers(len(shapes))]


def _no_numbers(command: np.ndarray, rng: Random) -> Any:
    things = (
        'seven', None, {}, object(), ['a'] * 7, [[1.0], [2.0, 3.0]], [10**400] * 7,
        [object()] * 7, b'1234567', {1, 2, 3, 4, 5, 6, 7},
    )  # fmt: skip
    return things[rng.integers(len(things))]


GARBAGE = {
    'NaN in a joint command': Garbage(
        8, Refusal.NOT_FINITE, lambda q, rng: _with(q, rng, np.nan)
    ),
    'infinity in a joint command': Garbage(
        8, Refusal.NOT_FINITE, lambda q, rng: _with(q, rng, rng.choice([-np.inf, np.inf]))
    ),
    'huge value in a joint command': Garbage(
        8, Refusal.OUT_OF_RANGE, lambda q, rng: _with(q, rng, -(10.0 ** rng.uniform(1, 308)))
    ),
    'joint command beyond the joint limits': Garbage(9, Refusal.OUT_OF_RANGE, _beyond),
    'joint command too far away': Garbage(10, Refusal.TOO_FAR, _far),
    'joint command of another shape': Garbage(13, Refusal.MALFORMED, _misshapen),
    'joint command without numbers': Garbage(13, Refusal.MALFORMED, _no_numbers),
}


def trace(made: Rig) -> bytes:
    """Advance one cycle; return the command and the state of the arm."""
    made.tick()
    motion = made.arm.data.qpos, made.arm.data.qvel
    return b''.join(part.tobytes() for part in (made.commands[-1], *motion))


@pytest.mark.parametrize('what', GARBAGE)
def test_a_bad_joint_command_changes_nothing(ledger, what):
    garbage = GARBAGE[what]
    for repeat in range(ledger.repeats):
        rng = generator(what, repeat)
        course = random_course(rng)
        with ledger.injection(garbage.row, what, bound_ms=2.0) as entry:
            clean, attacked = course.begin(), course.begin()

            for _ in range(TICKS):
                for _ in range(OFFERS):
                    bad = garbage.spoil(attacked.commands[-1], rng)
                    assert attacked.arm.command(bad) is garbage.refusal
                assert trace(attacked) == trace(clean)
            assert attacked.arm.refused[garbage.refusal] == OFFERS * TICKS
            entry.reaction_ms = entry.deviation_mm = 0.0
            entry.speed = speeds(np.array(attacked.tips), PERIOD).max()
            assert entry.speed <= course.cap()
