# SPDX-License-Identifier: Apache-2.0
"""What the controller is told cycle by cycle while joint commands come when they come."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lwr_description import POSITION_MAX, VELOCITY_MAX, ArmDescription
from lwr_guard import CommandGate, CommandWatch, GuardParameters, Refusal
from lwr_guard.interpolator import Interpolator

Array = NDArray[np.float64]

MOST_CYCLES = 5
"""After a longer gap the arm goes on as if only so many cycles had passed."""

SPARE = 0.95
"""Share of the permitted step that is used: the controller computes with other numbers."""

AT_REST = 1e-3
"""A joint slower than this is at rest [rad/s]."""


class Follower:
    """From where the controller stands, along good commands, within its limits, to rest.

    Attributes:
        watch: whether good commands still come.
        clamped: whether the limit on the step has held a joint back in the last cycle.

    """

    def __init__(
        self, guard: GuardParameters, start: Sequence[float], time_constant: float
    ) -> None:
        """Stand at `start`.

        Args:
            guard: what commands must keep to; answers go out once in its period.
            start: (7,) where the controller stands [rad].
            time_constant: of the filter that commands go through [s].

        """
        self._gate = CommandGate(
            guard, ArmDescription().limits, np.array(start, dtype=float)
        )
        self.watch = CommandWatch(guard)
        self.clamped = False
        self._interpolator = Interpolator(
            np.array(start, dtype=float), time_constant, guard.period
        )
        self._time_constant = time_constant
        self._cycle = guard.period
        self._sent = np.array(start, dtype=float)
        self._halted = False

    @property
    def at_rest(self) -> bool:
        """Tell whether all joints stand where they were last told to stand."""
        moving = self._interpolator
        near = np.abs(self._sent - moving.position).max() < AT_REST * self._cycle
        return bool(near and np.abs(moving.velocity).max() < AT_REST)

    def offer(self, q: ArrayLike, now: float) -> Refusal | None:
        """Head for the joint angles `q` (7,) [rad] from `now` [s] on; None means accepted."""
        refusal = self._gate.offer(q, now)
        if refusal is None and not self._halted:
            self.watch.good(now)
            self._interpolator.command(self._gate.last)
        return refusal

    def halt(self) -> None:
        """Come to rest ahead, as fast as the filter does, and heed no command any more."""
        if self._halted:
            return
        self._halted = True
        moving = self._interpolator
        # From here the filter neither overshoots nor comes back.
        rest = moving.position + 2.0 * self._time_constant * moving.velocity
        moving.command(np.clip(rest, -POSITION_MAX, POSITION_MAX))

    def advance(self, cycles: int, now: float, share: float) -> tuple[float, ...]:
        """Return the joint angles (7,) [rad] for the next cycle.

        Args:
            cycles: that have passed since the last answer, 1 if none is missing.
            now: reading of the steady clock [s].
            share: of the joint velocity limits that the controller accepts now.

        """
        self.watch.cycle(now)
        for _ in range(min(cycles, MOST_CYCLES)):
            self._interpolator.step()
        # If an answer was lost, the controller sees the step from the one before; it has gone
        # on meanwhile, how far is unknown: no step is ever longer than that of one cycle.
        step = SPARE * share * self._cycle * VELOCITY_MAX
        wanted = self._interpolator.position - self._sent
        held = np.clip(wanted, -step, step)
        self.clamped = bool((held != wanted).any())
        self._sent += held
        return tuple(self._sent.tolist())
