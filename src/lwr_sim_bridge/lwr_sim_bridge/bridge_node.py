# SPDX-License-Identifier: Apache-2.0
"""The sim bridge: a MuJoCo LWR 4+ on the topics of the real arm."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
import time

import numpy as np
from std_srvs.srv import SetBool, Trigger

from lwr_description import DOF, JOINT_NAMES, Kinematics, Mount
from lwr_guard.command_watch import POOR, SPARSE
from lwr_sim_bridge.errors import SimulationError
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.simulated_arm import TICK, SimulatedArm
from srnn_config import Parameters, parameter
from srnn_config.scene import load_scene
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_msgs_py.ros import commands, joints, result, wrench
from srnn_msgs_py.segment import FRAME
from srnn_msgs_py.wrench import Wrench
from srnn_node.errors import NodeError
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.rate import RateKeeper
from srnn_node.run import run

PRIORITY = 50
"""SCHED_FIFO priority to ask for."""

TICKS_PER_CYCLE = 4
"""Commands are taken and joint states go out every 4 ms; the controller runs at 1 kHz."""

CATCH_UP = 5
"""Cycles that are made up for after a delay; longer gaps slow simulated time down."""

CYCLES_PER_TRUTH = 5
"""Wrench and contact truth go out at 50 Hz."""


@dataclass(frozen=True)
class BridgeParameters(Parameters):
    """Parameters of the sim bridge node."""

    scene: str = parameter(doc='Scene file with obstacles, sensor noise and start.')
    seed: int = parameter(0, minimum=0, doc='Seed of the sensor noise.')
    mount: Mount = field(default_factory=Mount)
    arm: ArmParameters = field(default_factory=ArmParameters)


class BridgeNode(WorkspaceNode):
    """Simulates and reports while active; without commands the arm holds its pose."""

    PARAMETERS = BridgeParameters

    def __init__(self) -> None:
        """Create the node, unconfigured."""
        super().__init__('sim_bridge')

    def configure(self, parameters: BridgeParameters) -> None:
        """Build the simulated world, connect topics and services."""
        self._scene = load_scene(parameters.scene)
        self._settings = parameters
        self._kinematics = Kinematics(parameters.mount)
        self._build()
        self._measured = self.advertise('joint_states')
        self._external = self.advertise('external_torque/joint_states')
        self._wrench = self.advertise('wrench')
        self._truth = self.advertise('contact_truth')
        self.listen(
            'forward_position_controller/commands',
            lambda msg: commands.from_msg(msg, DOF), self._on_command,
        )
        self.listen('segment_result', result.from_msg, self._on_result)
        self.create_service(Trigger, '~/reset', self._on_reset)
        for index in range(len(self._scene.obstacles)):
            self.create_service(
                SetBool, f'~/set_obstacle_{index}', partial(self._on_set_obstacle, index)
            )

    def activate(self) -> None:
        """Let time run from now on."""
        self._rate = RateKeeper(TICKS_PER_CYCLE * TICK, time.monotonic(), CATCH_UP)
        self._skipped = 0

    def seconds_to_tick(self) -> float | None:
        """Return the time until the next cycle of the arm is due [s]."""
        return self._rate.seconds_to_tick(time.monotonic())

    def on_tick(self) -> None:
        """Advance the arm by one cycle and report what it measures.

        Raises:
            NodeError: the physics has gone wrong; there is no arm to report any more.

        """
        if not self._rate.take(time.monotonic()):
            return
        try:
            self._arm.step(TICKS_PER_CYCLE)
        except SimulationError as error:
            # It ends the node in one line: nobody needs to know how it got here.
            raise NodeError(str(error)) from error
        self._cycles += 1
        self._report()

    def health(self) -> Health:
        """Report timing and refused commands."""
        if not self.active:
            return Health()
        refused = {f'refused_{reason.name.lower()}': n for reason, n in self._arm.refused.items()}
        values = {
            'cycles': self._rate.taken,
            'overruns': self._rate.overruns,
            'skipped': self._rate.skipped,
            'holds': self._arm.watch.holds,
            'commands_answered': self._arm.watch.answered,
            **refused,
        }
        if self._arm.watch.holding:
            return Health(HealthLevel.WARN, 'no commands: the arm holds its pose', values)
        # Missing commands slow nothing down but a long gap, which `watch` bounds: no reaction.
        answered = self._arm.watch.answered
        if answered < SPARSE:
            level = HealthLevel.ERROR if answered < POOR else HealthLevel.WARN
            return Health(level, f'only {answered:.0%} of the cycles bring a command', values)
        skipped, self._skipped = self._rate.skipped - self._skipped, self._rate.skipped
        if skipped:
            return Health(HealthLevel.WARN, f'cycles given up: {skipped}', values)
        return Health(HealthLevel.OK, '', values)

    def _build(self) -> None:
        self._arm = SimulatedArm(
            self._settings.arm, self._settings.mount, self._scene,
            np.random.default_rng([self._settings.seed, 2]),
        )
        self._segments = 0
        self._cycles = 0

    def _report(self) -> None:
        now = self.get_clock().now().nanoseconds
        sample = self._arm.sample(now)
        measured, external = joints.to_msgs(sample, JOINT_NAMES)
        # The tracker acts on the joint state, so the torque that belongs to it goes first.
        self._external.publish(external)
        self._measured.publish(measured)
        if self._cycles % CYCLES_PER_TRUTH:
            return
        force = self._kinematics.tip_force(sample.position, sample.external_torque)
        self._wrench.publish(wrench.to_msg(Wrench(now, FRAME, force, np.zeros(3))))
        self._publish_truth(now)

    def _publish_truth(self, now: int) -> None:
        """Report the largest low-passed force since the last report, in its direction."""
        truth = self._arm.truth
        size = float(np.linalg.norm(truth.low_pass))
        direction = truth.low_pass / size if size > 1e-9 else np.array([1.0, 0.0, 0.0])
        peak = Wrench(now, FRAME, truth.peak * direction, np.zeros(3))
        self._truth.publish(wrench.to_msg(peak))
        self._arm.clear_peak()

    def _on_command(self, command: np.ndarray) -> None:
        if self.active:
            self._arm.command(command)

    def _on_result(self, value: SegmentResult) -> None:
        if value.code in (ResultCode.DONE, ResultCode.BLOCKED):
            self._segments += 1
            self._arm.set_segment(self._segments)

    def _on_reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        if self.active:
            response.success = False
            response.message = 'the arm would jump: deactivate the sim bridge first'
            return response
        try:
            self._build()
            response.success, response.message = True, 'back at the start of the scene'
        except SimulationError as error:
            response.success, response.message = False, str(error)
        return response

    def _on_set_obstacle(
        self, index: int, request: SetBool.Request, response: SetBool.Response
    ) -> SetBool.Response:
        self._arm.set_obstacle(index, request.data)
        present = ', '.join(map(str, self._arm.obstacles_present)) or 'none'
        response.success, response.message = True, f'obstacles present: {present}'
        return response


def main(args: Sequence[str] | None = None) -> int:
    """Run the sim bridge as a process."""
    return run(BridgeNode, args, priority=PRIORITY)


if __name__ == '__main__':
    raise SystemExit(main())
