# SPDX-License-Identifier: Apache-2.0
"""The FRI driver: a real LWR 4+ on the topics of the sim bridge."""

from collections.abc import Sequence
from dataclasses import dataclass, field
import time

import numpy as np
from std_srvs.srv import Trigger

from lwr_description import DOF, JOINT_NAMES, Kinematics, Mount
from lwr_fri_driver.core.parameters import DriverParameters
from lwr_fri_driver.core.phase import ENGAGED, Phase
from lwr_fri_driver.core.reports import Sample, Wish
from lwr_fri_driver.errors import LoopError
from lwr_fri_driver.loop_client import LoopClient
from lwr_fri_driver.loop_process import LoopParameters
from srnn_config import Parameters
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import commands, joints, wrench
from srnn_msgs_py.segment import FRAME
from srnn_msgs_py.wrench import Wrench
from srnn_node.errors import NodeError
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.run import run

PRIORITY = 50
"""SCHED_FIFO priority to ask for; the process that answers the controller asks for more."""

PATIENCE = 0.0003
"""Time between two looks for a measurement that is due [s]."""

CYCLES_PER_WRENCH = 5

SLEEPING_S = 2.0
"""A process that has not reported for so long sleeps [s]."""

LEVELS = {
    Phase.COMMANDING: HealthLevel.OK,
    Phase.FAULT: HealthLevel.ERROR,
}
"""Of a phase while the node is active; the others are warnings."""


@dataclass(frozen=True)
class DriverNodeParameters(Parameters):
    """Parameters of the FRI driver node."""

    mount: Mount = field(default_factory=Mount)
    fri: DriverParameters = field(default_factory=DriverParameters)


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
        self._kinematics = Kinematics(parameters.mount)
        self._client = LoopClient(LoopParameters(parameters.mount, parameters.fri))
        self._samples = 0
        self._look_at = time.monotonic()
        self._told = ''
        self._measured = self.advertise('joint_states')
        self._external = self.advertise('external_torque/joint_states')
        self._wrench = self.advertise('wrench')
        self.listen(
            'forward_position_controller/commands',
            lambda msg: commands.from_msg(msg, DOF), self._on_command,
        )
        self.create_service(Trigger, '~/reset', self._on_reset)
        self.get_logger().info(
            f'listening for the controller on UDP port {self._client.port}, '
            f'{self._client.status.values["scheduling"]}'
        )

    def activate(self) -> None:
        """Ask for command mode; it begins when the controller is fit, and its program agrees."""
        self._client.wish(Wish.START)

    def deactivate(self) -> None:
        """Bring the arm to rest and leave command mode."""
        self._client.wish(Wish.STOP)
        until = time.monotonic() + self._settings.link.answer_time
        self._client.take()
        while self._client.status.phase in ENGAGED and time.monotonic() < until:
            self._client.wait(until - time.monotonic())
            self._client.take()

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
            self._publish(sample)

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
        if self._client.silent_for > SLEEPING_S:
            return Health(HealthLevel.ERROR, 'the process that answers the controller sleeps')
        values = {'phase': status.phase.name, **status.values}
        level = LEVELS.get(status.phase, HealthLevel.WARN) if self.active else HealthLevel.OK
        if status.words != self._told:
            self._told = status.words
            self.get_logger().info(status.words)
        return Health(level, status.words, values)

    def _publish(self, sample: Sample) -> None:
        position, velocity, torque, external = sample.values
        measured = JointSample(sample.stamp_ns, position, velocity, torque, external)
        message, external_message = joints.to_msgs(measured, JOINT_NAMES)
        # The tracker acts on the joint state, so the torque that belongs to it goes first.
        self._external.publish(external_message)
        self._measured.publish(message)
        self._samples += 1
        if self._samples % CYCLES_PER_WRENCH == 0:
            force = self._kinematics.tip_force(position, external)
            value = Wrench(sample.stamp_ns, FRAME, force, np.zeros(3))
            self._wrench.publish(wrench.to_msg(value))

    def _on_command(self, command: np.ndarray) -> None:
        if self.active:
            self._client.command(command)

    def _on_reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        try:
            self._client.wish(Wish.RESET)
            response.success = True
            response.message = (
                'command mode is asked for; the arm holds until the tracker is reset as well'
                if self.active else 'ready to be activated'
            )
        except LoopError as error:
            response.success, response.message = False, str(error)
        return response


def main(args: Sequence[str] | None = None) -> int:
    """Run the FRI driver as a process."""
    return run(DriverNode, args, priority=PRIORITY)


if __name__ == '__main__':
    raise SystemExit(main())
