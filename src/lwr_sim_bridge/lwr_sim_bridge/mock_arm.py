# SPDX-License-Identifier: Apache-2.0
"""An arm without physics: it is where it was told to be, and touches nothing."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lwr_description import Kinematics, Mount
from lwr_guard import CommandGate, CommandWatch, GuardParameters, Refusal
from lwr_sim_bridge.simulated_arm import TICK
from srnn_msgs_py.joints import JointSample


class MockArm:
    """Takes the commands that the simulated arm would take, and obeys them within a cycle.

    Attributes:
        watch: whether commands still come.

    """

    def __init__(self, guard: GuardParameters, mount: Mount, start: ArrayLike) -> None:
        """Hold still with the tip above `start` (2,) of the plane [m].

        Raises:
            UnreachableError: the arm cannot reach the start.

        """
        self._kinematics = Kinematics(mount)
        self._position = self._kinematics.inverse((*np.asarray(start), 0.0))
        self._velocity = np.zeros_like(self._position)
        self._gate = CommandGate(guard, self._kinematics.limits, self._position)
        self.watch = CommandWatch(guard)
        self._ticks = 0

    @property
    def time(self) -> float:
        """Time of the arm [s]."""
        return self._ticks * TICK

    @property
    def refused(self) -> Mapping[Refusal, int]:
        """How many commands were refused, by reason."""
        return MappingProxyType(self._gate.refused)

    def command(self, q: ArrayLike) -> Refusal | None:
        """Be at the joint angles `q` (n,) [rad] in the next cycle.

        Returns:
            None when accepted, else why not; the arm then stays where it is.

        """
        refusal = self._gate.offer(q, self.time)
        if refusal is None:
            self.watch.good(self.time)
        return refusal

    def step(self, ticks: int) -> None:
        """Advance one cycle."""
        self._ticks += ticks
        self._velocity = (self._gate.last - self._position) / (ticks * TICK)
        self._position = self._gate.last.copy()
        self.watch.cycle(self.time)

    def sample(self, stamp_ns: int) -> JointSample:
        """Return where the arm is, stamped `stamp_ns` [ns]; nothing pushes it."""
        position: NDArray[np.float64] = self._position.copy()
        return JointSample(
            stamp_ns, position, self._velocity.copy(), self._kinematics.gravity(position),
            np.zeros_like(self._position),
        )
