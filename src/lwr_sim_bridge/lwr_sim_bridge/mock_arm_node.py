# SPDX-License-Identifier: Apache-2.0
"""The mock arm: obeys perfectly on the topics of the real one, without physics."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from lwr_description import Mount
from lwr_guard import GuardParameters
from lwr_sim_bridge.arm_node import ArmNode
from lwr_sim_bridge.mock_arm import MockArm
from srnn_config import Parameters, parameter
from srnn_config.scene import load_scene
from srnn_node.run import run

PRIORITY = 50
"""SCHED_FIFO priority to ask for."""


@dataclass(frozen=True)
class MockArmParameters(Parameters):
    """Parameters of the mock arm node."""

    scene: str = parameter(doc='Scene file with the start; its obstacles are ignored.')
    mount: Mount = field(default_factory=Mount)
    guard: GuardParameters = field(default_factory=GuardParameters)


class MockArmNode(ArmNode):
    """Moves and reports while active; without commands the arm stays where it is."""

    PARAMETERS = MockArmParameters

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('mock_arm')

    def configure(self, parameters: MockArmParameters) -> None:
        """Connect topics."""
        start = load_scene(parameters.scene).start
        self.begin(MockArm(parameters.guard, parameters.mount, start), parameters.mount)


def main(args: Sequence[str] | None = None) -> int:
    """Run the mock arm as a process."""
    return run(MockArmNode, args, priority=PRIORITY)


if __name__ == '__main__':
    raise SystemExit(main())
