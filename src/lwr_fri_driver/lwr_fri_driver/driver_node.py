# SPDX-License-Identifier: Apache-2.0
"""The FRI driver: a real LWR 4+ on the topics of the sim bridge."""

from collections.abc import Sequence
import time

import numpy as np

from lwr_description import DOF, JOINT_NAMES, Kinematics
from lwr_fri_driver.core.driver_health import driver_health
from lwr_fri_driver.core.phase import Phase
from lwr_fri_driver.core.reports import Wish
from lwr_fri_driver.errors import LoopError
from lwr_fri_driver.loop_client import LoopClient
from lwr_fri_driver.loop_process import LoopParameters
from lwr_fri_driver.node_parameters import DriverNodeParameters
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import commands
from srnn_node import trigger
from srnn_node.arm_report import ArmReport
from srnn_node.errors import NodeError
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run

PRIORITY = 50
"""SCHED_FIFO priority to ask for; the process that answers the controller asks for more."""

PATIENCE = 0.0003
"""Time between two looks for a measurement that is due [s]."""


class DriverNode(WorkspaceNode):
    """Inactive it mirrors the controller in monitor mode; active it asks for command mode.

    Joint states go out while commands move the arm, and only then: whoever acts on them
    must not take an arm that follows nobody for one that follows badly.
    """

    PARAMETERS = DriverNodeParameters

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('fri_driver')

    def configure(self, parameters: DriverNodeParameters) -> None:
        """Start the process that answers the controller, connect topics and services."""
        self._settings = parameters.fri
        kinematics = Kinematics(parameters.mount)
        self._client = LoopClient(LoopParameters(parameters.mount, parameters.fri))
        self._look_at = time.monotonic()
        self._told = ''
        self._report = ArmReport(self, JOINT_NAMES, kinematics.tip_force)
        self.listen(
            'forward_position_controller/commands',
            lambda msg: commands.from_msg(msg, DOF), self._on_command,
        )
        trigger.offer(self, 'reset', self._reset, LoopError)
        self.get_logger().info(
            f'listening for the controller on UDP port {self._client.port}, '
            f'{self._client.status.values["scheduling"]}'
        )

    def activate(self) -> None:
        """Ask for command mode; it begins when the controller is fit, and its program agrees."""
        self._client.wish(Wish.START)

    def deactivate(self) -> None:
        """Bring the arm to rest and leave command mode."""
        self._client.leave(self._settings.link.answer_time)

    def cleanup(self) -> None:
        """End the process that answers the controller."""
        self._client.close()

    def seconds_to_tick(self) -> float | None:
        """Return the time until the next look for a measurement [s]."""
        return self._look_at - time.monotonic()

    def on_tick(self) -> None:
        """Publish the newest measurement.

        Raises:
            NodeError: nobody answers the controller any more.

        """
        try:
            sample = self._client.take()
        except LoopError as error:
            raise NodeError(str(error)) from error
        overdue = sample is None and self._client.status.phase is Phase.COMMANDING
        pause = PATIENCE if overdue else self._settings.link.cycle - PATIENCE
        self._look_at = time.monotonic() + pause
        if sample is not None:
            self._report.publish(JointSample(sample.stamp_ns, *sample.values))

    def health(self) -> Health:
        """Report where the conversation with the controller is, and all of its figures."""
        if self.state == 'unconfigured':
            return Health()
        try:
            if not self.active:
                self._client.take()
        except LoopError as error:
            return Health(HealthLevel.ERROR, str(error))
        status = self._client.status
        health = driver_health(status, self._client.silent_for, self.active)
        asleep = health.message != status.words
        if status.words != self._told and not asleep:
            self._told = status.words
            self.get_logger().info(status.words)
        return health

    def _on_command(self, command: np.ndarray) -> None:
        if self.active:
            self._client.command(command)

    def _reset(self) -> str:
        self._client.wish(Wish.RESET)
        if self.active:
            return 'command mode is asked for; the arm holds until the tracker is reset as well'
        return 'ready to be activated'


def main(args: Sequence[str] | None = None) -> int:
    """Run the FRI driver as a process."""
    return run(DriverNode, args, priority=PRIORITY)


if __name__ == '__main__':
    raise SystemExit(main())
