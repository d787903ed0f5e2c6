# SPDX-License-Identifier: Apache-2.0
"""The sim bridge: an arm in MuJoCo on the topics of the real one."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from lwr_description import Mount
from lwr_sim_bridge.arm_node import ArmNode
from lwr_sim_bridge.errors import SimulationError
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.ros.scene_topics import SceneTopics
from lwr_sim_bridge.simulated_arm import SimulatedArm
from srnn_config import Parameters, parameter
from srnn_config.scene import load_scene
from srnn_node import trigger
from srnn_node.errors import NotNowError
from srnn_node.run import run

PRIORITY = 50
"""SCHED_FIFO priority to ask for."""


@dataclass(frozen=True)
class BridgeParameters(Parameters):
    """Parameters of the sim bridge node."""

    scene: str = parameter(doc='Scene file with obstacles, sensor noise and start.')
    seed: int = parameter(0, minimum=0, doc='Seed of the sensor noise.')
    mount: Mount = field(default_factory=Mount)
    arm: ArmParameters = field(default_factory=ArmParameters)

    def check(self) -> None:
        """Refuse parameters that do not fit the arm."""
        self.arm.fit(self.mount.description)


class BridgeNode(ArmNode):
    """Simulates and reports while active; without commands the arm holds its pose."""

    PARAMETERS = BridgeParameters

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('sim_bridge')

    def configure(self, parameters: BridgeParameters) -> None:
        """Build the simulated world, connect topics and services."""
        self._scene = load_scene(parameters.scene)
        self._settings = parameters
        self.begin(self._build(), parameters.mount)
        self._topics = SceneTopics(self, len(self._scene.obstacles), lambda: self._arm)
        trigger.offer(self, 'reset', self._reset, SimulationError)

    def _build(self) -> SimulatedArm:
        return SimulatedArm(
            self._settings.arm, self._settings.mount, self._scene,
            np.random.default_rng([self._settings.seed, 2]),
        )

    def report_truth(self, stamp_ns: int) -> None:
        """Report contact forces, for scoring only."""
        self._topics.report(stamp_ns)

    def _reset(self) -> str:
        if self.active:
            raise NotNowError('the arm would jump: deactivate the sim bridge first')
        self._arm = self._build()
        self._topics.segments = 0
        return 'back at the start of the scene'


def main(args: Sequence[str] | None = None) -> int:
    """Run the sim bridge as a process."""
    return run(BridgeNode, args, priority=PRIORITY)


if __name__ == '__main__':
    raise SystemExit(main())
