# SPDX-License-Identifier: Apache-2.0
"""What every arm that is computed here does on the topics of the real one."""

from collections.abc import Mapping
import time
from typing import Protocol

import numpy as np

from lwr_description import Kinematics, Mount
from lwr_guard import CommandWatch, Refusal
from lwr_guard.command_watch import POOR, SPARSE
from lwr_sim_bridge.errors import SimulationError
from lwr_sim_bridge.simulated_arm import TICK
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import commands
from srnn_node.arm_report import ArmReport
from srnn_node.errors import NodeError
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.rate import RateKeeper

TICKS_PER_CYCLE = 4
"""Commands are taken and joint states go out every 4 ms; the controller runs at 1 kHz."""

CATCH_UP = 5
"""Cycles that are made up for after a delay; longer gaps slow the arm's time down."""


class Arm(Protocol):
    """What moves."""

    watch: CommandWatch

    @property
    def refused(self) -> Mapping[Refusal, int]:
        """How many commands were refused, by reason."""

    def command(self, q: np.ndarray) -> Refusal | None:
        """Head for the joint angles `q` (n,) [rad]."""

    def step(self, ticks: int) -> None:
        """Advance by ticks of 1 ms."""

    def sample(self, stamp_ns: int) -> JointSample:
        """Return what the arm measures now."""


class ArmNode(WorkspaceNode):
    """Moves and reports while active; without commands the arm holds its pose."""

    def begin(self, arm: Arm, mount: Mount) -> None:
        """Connect the topics of an arm that stands where it begins."""
        self._arm = arm
        kinematics = Kinematics(mount)
        self._report = ArmReport(self, kinematics.joints, kinematics.tip_force)
        self.listen(
            'forward_position_controller/commands',
            lambda msg: commands.from_msg(msg, len(kinematics.joints)), self._on_command,
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
        now = self.get_clock().now().nanoseconds
        if self._report.publish(self._arm.sample(now)):
            self.report_truth(now)

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

    def report_truth(self, stamp_ns: int) -> None:
        """Publish what only the one who computes the arm can know, at 50 Hz."""

    def _on_command(self, command: np.ndarray) -> None:
        if self.active:
            self._arm.command(command)
