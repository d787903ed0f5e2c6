# SPDX-License-Identifier: Apache-2.0
"""An arm as ros2_control shows it: plain messages, a namespace, joints by alphabet.

Nothing here knows the nodes of the workspace. Behind it is the simulated arm, so that it feels.
"""

from collections.abc import Sequence

import numpy as np
import rclpy
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from lwr_sim_bridge.simulated_arm import SimulatedArm
from srnn_bringup.config import Configuration

NAMESPACE = 'cell'
REMAPPED = (
    'joint_states', 'external_torque/joint_states', 'forward_position_controller/commands',
)  # fmt: skip
PERIOD_S = 0.004


def remappings() -> tuple[str, ...]:
    """Return the arguments that attach the tracker."""
    return tuple(
        argument for name in REMAPPED for argument in ('-r', f'{name}:=/{NAMESPACE}/{name}')
    )


class Ros2ControlArm:
    """joint_state_broadcaster and forward_command_controller, as far as their topics go."""

    def __init__(self, configuration: Configuration) -> None:
        described = configuration.arm
        self.arm = SimulatedArm(
            described.arm, described.mount, configuration.scene, np.random.default_rng(1)
        )
        self.node = rclpy.create_node('controller_manager', namespace=NAMESPACE)
        self.sizes: set[int] = set()
        names = described.mount.description.joints
        self._order = sorted(range(len(names)), key=names.__getitem__)
        self._names = [names[i] for i in self._order]
        self._states = self.node.create_publisher(JointState, 'joint_states', 10)
        self._torques = self.node.create_publisher(
            JointState, 'external_torque/joint_states', 10
        )
        self.node.create_subscription(
            Float64MultiArray, 'forward_position_controller/commands', self._on_command, 10
        )
        self.node.create_timer(PERIOD_S, self._cycle)

    def _cycle(self) -> None:
        self.arm.step(round(1e3 * PERIOD_S))
        sample = self.arm.sample(0)
        stamp = self.node.get_clock().now().to_msg()
        torques = JointState(name=self._names, effort=self._ordered(sample.external_torque))
        states = JointState(
            name=self._names,
            position=self._ordered(sample.position),
            velocity=self._ordered(sample.velocity),
            effort=self._ordered(sample.torque),
        )
        for publisher, message in ((self._torques, torques), (self._states, states)):
            message.header.stamp = stamp
            publisher.publish(message)

    def _ordered(self, values: np.ndarray) -> Sequence[float]:
        return values[self._order].tolist()

    def _on_command(self, msg: Float64MultiArray) -> None:
        self.sizes.add(len(msg.data))
        self.arm.command(msg.data)
