# SPDX-License-Identifier: Apache-2.0
"""The sim bridge as a process whose physics goes wrong, in the way that is named first."""

from collections.abc import Callable
import sys

import mujoco
import numpy as np

from lwr_sim_bridge import SimulatedArm
from lwr_sim_bridge.bridge_node import BridgeNode
from srnn_node.run import run

SOUND_CYCLES = 50
"""The physics goes wrong so many cycles after somebody listens."""


def _set(field: str, value: float) -> Callable[[SimulatedArm, int], None]:
    def poison(arm: SimulatedArm, joint: int) -> None:
        getattr(arm.data, field)[joint] = value

    return poison


def _warn(kind: mujoco.mjtWarning) -> Callable[[SimulatedArm, int], None]:
    def poison(arm: SimulatedArm, joint: int) -> None:
        arm.data.warning.number[kind] += 1

    return poison


def _set_back(arm: SimulatedArm, joint: int) -> None:
    arm.data.time -= 0.01 * (joint + 1)


POISONS: dict[str, Callable[[SimulatedArm, int], None]] = {
    'NaN among the simulated angles': _set('qpos', np.nan),
    'infinity among the simulated velocities': _set('qvel', -np.inf),
    'simulated velocity of 1000 rad/s': _set('qvel', 1e3),
    'simulated angle of 1e12 rad': _set('qpos', 1e12),
    'simulated torque of 1e9 Nm': _set('qfrc_applied', 1e9),
    'BADQPOS from the simulator': _warn(mujoco.mjtWarning.mjWARN_BADQPOS),
    'BADQVEL from the simulator': _warn(mujoco.mjtWarning.mjWARN_BADQVEL),
    'BADQACC from the simulator': _warn(mujoco.mjtWarning.mjWARN_BADQACC),
    'BADCTRL from the simulator': _warn(mujoco.mjtWarning.mjWARN_BADCTRL),
    'simulated time set back': _set_back,
    'simulator reset': lambda arm, joint: mujoco.mj_resetData(arm.model, arm.data),
}
"""What goes wrong, by name: it happens to an arm, at one of its joints."""


class BreakingBridge(BridgeNode):
    """A sim bridge that is sound until it has been heard for a while."""

    def __init__(self) -> None:
        super().__init__()
        self._heard = 0

    def on_tick(self) -> None:
        self._heard += self._report.measured.get_subscription_count() > 0
        if self._heard == SOUND_CYCLES:
            POISONS[sys.argv[1]](self._arm, SOUND_CYCLES % 7)
        super().on_tick()


if __name__ == '__main__':
    raise SystemExit(run(BreakingBridge, [sys.argv[0], *sys.argv[2:]]))
