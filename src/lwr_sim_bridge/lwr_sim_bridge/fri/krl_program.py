# SPDX-License-Identifier: Apache-2.0
"""The KRL program that starts and stops command mode as the other side asks."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

POSITION, JOINT_IMPEDANCE = 10, 30
"""`$stiffness.strategy`."""

PERIOD = 0.05
"""The program looks at what it was told this often [s]."""

INTS = 16


@dataclass(frozen=True)
class Scheme:
    """What a published program reads in `$FRI_FRM_INT` and writes to `$FRI_TO_INT`.

    Indices count from 0; KRL counts from 1.
    """

    strategy: int
    wish: int
    start: int
    stop: int
    told: int
    opened: int
    started: int
    stopped: int
    first_in_position: bool


SCHEMES = {
    'ros_control': Scheme(0, 1, 1, 0, 1, 10, 1, 0, True),
    'fri_library': Scheme(14, 15, 10, 20, 15, 10, 20, 10, False),
}
"""By name: `ros_control.src` of CentroEPiaggio, and `FRIControl.src` of the FRI library."""


class Step(Enum):
    """What the program does next."""

    NOTHING = 0
    START = 1
    STOP = 2


class KrlProgram:
    """Waits for the wish, then for a good link, starts, and stops when the wish is gone.

    Attributes:
        strategy: of the law that the next start is to have.

    """

    def __init__(self, scheme: str) -> None:
        """Open the interface: monitor mode."""
        self._scheme = SCHEMES[scheme]
        self._first = self._scheme.first_in_position
        self._running = False
        self._told = self._scheme.opened
        self._next = 0.0
        self.strategy = POSITION

    @property
    def ints(self) -> tuple[int, ...]:
        """What `$FRI_TO_INT` says."""
        values = [0] * INTS
        values[self._scheme.told] = self._told
        return tuple(values)

    def step(self, now: float, heard: Sequence[int], perfect: bool) -> Step:
        """Go on.

        Args:
            now: time of the controller [s].
            heard: `$FRI_FRM_INT` of the newest command.
            perfect: whether the quality is.

        """
        if now < self._next:
            return Step.NOTHING
        self._next = now + PERIOD
        scheme, wish = self._scheme, heard[self._scheme.wish]
        if not self._running and wish == scheme.start and perfect:
            strategy = heard[scheme.strategy]
            if self._first or strategy not in (POSITION, JOINT_IMPEDANCE):
                strategy = POSITION
            self.strategy, self._first = strategy, False
            self._running, self._told = True, scheme.started
            return Step.START
        if self._running and wish == scheme.stop:
            self._running, self._told = False, scheme.stopped
            return Step.STOP
        return Step.NOTHING
