# SPDX-License-Identifier: Apache-2.0
"""The emulated controller of the LWR 4+: monitor mode, command mode, and what ends it."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lwr_description import VELOCITY_MAX, Kinematics, Mount
from lwr_sim_bridge.fri.answer_statistics import OK, PERFECT, AnswerStatistics
from lwr_sim_bridge.fri.chain import Chain
from lwr_sim_bridge.fri.commanded_path import CommandedPath
from lwr_sim_bridge.fri.krl_program import INTS, JOINT_IMPEDANCE, KrlProgram, Step
from lwr_sim_bridge.fri.orders import JOINT_LAW, objection_to, objection_to_start
from lwr_sim_bridge.fri.parameters import ControllerParameters
from lwr_sim_bridge.fri.wire import COUNTERS, Order, Reading, pack, unpack
from lwr_sim_bridge.simulated_arm import TICK, SimulatedArm

Array = NDArray[np.float64]

MONITOR, COMMAND = 1, 2
POSITION_CONTROL, JOINT_IMPEDANCE_CONTROL = 1, 3
DRIVES_ON = 0x7F

POSITION_STIFFNESS, START_STIFFNESS, DAMPING = 2000.0, 1000.0, 0.7
"""Of position control [Nm/rad], and of joint impedance until a command says otherwise."""

TEMPERATURE = 35.0
"""Of every joint [degrees Celsius]; the simulated arm does not warm up."""

_TOOL_WRENCH = [0, 1, 2, 5, 4, 3]
"""X, Y, Z, RX, RY, RZ in the order of the wire."""


class FriController:
    """A stand-in for the KRC2lr: `measure` and `sent`, `receive` what is answered, `advance`.

    It keeps no clock; every cycle is as long as it was set. What KUKA has not published is
    a choice, see `PatienceParameters`.

    Attributes:
        arm: the one behind it.
        state: `MONITOR` or `COMMAND`.
        control: `POSITION_CONTROL` or `JOINT_IMPEDANCE_CONTROL`.
        power: bits of the drives that are on.
        error: bits of drive errors.
        warning: bits of warnings.
        message: what the operator reads, empty while all is well.
        statistics: of the answers.
        rejected: datagrams that are no command.
        late: commands that came after their cycle.
        tamper: changes what is measured before it is sent, for tests.

    """

    def __init__(
        self, arm: SimulatedArm, mount: Mount, cycle: int, program: KrlProgram,
        parameters: ControllerParameters,
    ) -> None:
        """Hold the arm where it is, in monitor mode, drives on.

        Args:
            arm: at rest.
            mount: how it stands and what it holds.
            cycle: time between two packets [ms], the argument of friOpen.
            program: that runs.
            parameters: of the controller.

        """
        self.arm = arm
        self.state, self.control = MONITOR, POSITION_CONTROL
        self.power, self.error, self.warning = DRIVES_ON, 0, 0
        self.message = ''
        self.rejected = 0
        self.late = 0
        self.tamper: Callable[[Reading], Reading] = lambda reading: reading
        self._parameters = parameters
        self._ticks, self._period = cycle, cycle * TICK
        self._longest_step = parameters.velocity_share * self._period * VELOCITY_MAX
        self._kinematics = Kinematics(mount)
        self._chain = Chain(mount.tool_length)
        self._program = program
        self.statistics = AnswerStatistics(parameters.patience)
        self._sequence = COUNTERS - 1
        self._reflected = 0
        self._sent_at = 0.0
        self._heard: tuple[int, ...] = (0,) * INTS
        self._answer: tuple[Order, float] | None = None
        self._last: Order | None = None
        self._path = CommandedPath(arm.data.qpos)
        self._flags = 0
        self._set_law(POSITION_CONTROL)

    @property
    def quality(self) -> int:
        """How the controller rates the link."""
        return self.statistics.quality

    @property
    def target(self) -> Array:
        """Commanded joint angles (7,) [rad]."""
        return self._path.target

    def measure(self) -> bytes:
        """Begin a cycle: return the measurement that goes out now."""
        self._sequence = (self._sequence + 1) % COUNTERS
        self._answer = None
        return pack(self._sequence, self._reflected, self.tamper(self._read()))

    def sent(self, now: float) -> None:
        """Take in that the measurement went out at `now` [s] of any clock."""
        self._sent_at = now

    def receive(self, data: bytes, now: float) -> None:
        """Take in a datagram that arrived at `now` [s], by the clock of `sent`."""
        order = unpack(data)
        if order is None:
            self.rejected += 1
        elif order.reflected != self._sequence:
            self.late += 1
        elif self._answer is None:
            self._answer = order, max(now - self._sent_at, 0.0)
            self._reflected = order.sequence

    def advance(self) -> None:
        """End the cycle: judge the answer, or its absence, and move the arm.

        Raises:
            SimulationError: the physics has gone wrong.

        """
        order = None
        if self._answer is None:
            self.statistics.miss()
        else:
            order, latency = self._answer
            self.statistics.answer(latency)
            self._heard, self._last = order.ints, order
        self._path.begin_cycle()
        self._run_program()
        if self.state == COMMAND:
            self._command(order)
        self._move()

    def acknowledge(self) -> None:
        """Do what an operator does after a stop: read the message, switch the drives on."""
        self.power, self.error, self.warning, self.message = DRIVES_ON, 0, 0, ''

    def fail(self, message: str, error: int = 0) -> None:
        """Stop: brakes on, drives off, monitor mode; `error` are the bits of drive errors."""
        self.state, self.power, self.error, self.message = MONITOR, 0, error, message
        self._path.stand(self.arm.data.qpos)

    def _run_program(self) -> None:
        perfect = self.quality == PERFECT
        step = self._program.step(self.arm.time, self._heard, perfect)
        if step is Step.STOP and self.state == COMMAND:
            self.state = MONITOR
            self._path.stand(self.target)
        elif step is Step.START and self.power == DRIVES_ON:
            self._start()

    def _start(self) -> None:
        assert self._last is not None  # The wish came with it.
        objection = objection_to_start(
            self._last, self.target, self._parameters.patience.mirror_tolerance
        )
        if objection:
            self.fail(objection)
            return
        strategy = self._program.strategy
        self._set_law(
            JOINT_IMPEDANCE_CONTROL if strategy == JOINT_IMPEDANCE else POSITION_CONTROL
        )
        self._flags = self._last.flags
        self._path.stand(self.target)
        self.state = COMMAND

    def _command(self, order: Order | None) -> None:
        if self.quality < OK:
            self.fail('FRI: the link is too poor for command mode')
        elif order is None:
            if self.statistics.in_a_row > self._parameters.patience.extrapolated:
                self.fail('FRI: too many answers are missing')
            else:
                self._path.bridge()
        elif objection := objection_to(
            order, self._flags, self.target, self._longest_step
        ):
            self.fail(objection)
        else:
            self._path.obey(order.position)
            if self.control == JOINT_IMPEDANCE_CONTROL and order.flags & JOINT_LAW == JOINT_LAW:
                self.arm.set_impedance(order.stiffness, order.damping)

    def _set_law(self, control: int) -> None:
        self.control = control
        stiff = POSITION_STIFFNESS if control == POSITION_CONTROL else START_STIFFNESS
        self.arm.set_impedance([stiff] * 7, [DAMPING] * 7)

    def _move(self) -> None:
        """Move the arm for one cycle."""
        if not self._path.moves:
            self.arm.command(self.target)
            self.arm.step(self._ticks)
            return
        for point in self._path.points(self._ticks):
            self.arm.command(point)
            self.arm.step(1)

    def _read(self) -> Reading:
        sample, statistics, path = self.arm.sample(0), self.statistics, self._path
        q, external = sample.position, sample.external_torque
        poses, jacobians = self._chain.poses_and_jacobians([q, path.base, path.target])
        pose, base_pose, target_pose = poses
        jacobian = jacobians[0]
        wrench = np.linalg.lstsq(jacobian.T, external, rcond=None)[0]
        return Reading(
            to_reals=(0.0,) * 16, to_ints=self._program.ints, to_bools=0, fill=0,
            timestamp=self.arm.time, state=self.state, quality=self.quality,
            measurement_period=self._period, command_period=self._period,
            safety_limits=self._parameters.velocity_share,
            answer_rate=statistics.answer_rate, latency=statistics.latency,
            jitter=statistics.jitter, miss_rate=1.0 - statistics.answer_rate,
            misses=statistics.misses,
            power=self.power, control=self.control, error=self.error, warning=self.warning,
            temperature=(TEMPERATURE,) * 7,
            position=q, pose=pose.ravel(), commanded=path.base,
            offset=path.target - path.base, commanded_pose=base_pose.ravel(),
            pose_offset=(target_pose - base_pose).ravel(),
            torque=sample.torque, external_torque=external, tool_wrench=wrench[_TOOL_WRENCH],
            jacobian=jacobian[_TOOL_WRENCH].ravel(),
            mass_matrix=self._kinematics.mass_matrix(q).ravel(),
            gravity=self._kinematics.gravity(q),
        )  # fmt: skip
