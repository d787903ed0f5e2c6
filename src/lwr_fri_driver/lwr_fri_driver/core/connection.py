# SPDX-License-Identifier: Apache-2.0
"""The conversation with the controller: every packet of it gets the answer that is safe now."""

from math import inf, isfinite

from numpy.typing import ArrayLike

from lwr_fri_driver.core.command import Motion, encode
from lwr_fri_driver.core.fitness import Fitness, Gravity, Unfit, in_words
from lwr_fri_driver.core.follower import Follower
from lwr_fri_driver.core.handshake import HANDSHAKES
from lwr_fri_driver.core.link_estimate import LinkEstimate
from lwr_fri_driver.core.measurement import Measurement, decode
from lwr_fri_driver.core.parameters import STRATEGIES, DriverParameters
from lwr_fri_driver.core.phase import ENGAGED, Fault, Phase
from lwr_fri_driver.core.sequence import WRAP, Arrival, SequenceWatch
from lwr_fri_driver.core.words import DRIVES_ON, Control, Flags, FriState, Quality
from lwr_fri_driver.errors import DatagramError
from lwr_guard import Refusal

FLAGS = {
    Control.POSITION: Flags.JOINT_POSITION,
    Control.JOINT_IMPEDANCE: (
        Flags.JOINT_POSITION | Flags.JOINT_TORQUE | Flags.JOINT_STIFFNESS | Flags.JOINT_DAMPING
    ),
}
"""Which fields of a command count; they may not change in command mode."""

ATTEMPTS = 2
"""Published KRL programs always start the first time in joint position."""


class Connection:
    """Mirrors the controller until it may command it, and commands it only on request.

    Attributes:
        phase: where the conversation is.
        fault: why it was broken off.
        cause: the same for a person, with details.
        unfit: what is wrong with the arm or its controller.
        measurement: the newest one; None before the first.
        sequence: which packets came.
        link: the driver's own opinion of the link.
        follower: what moves the arm; None before the first command mode.
        malformed: packets that are no measurement.
        refused: joint commands that were, by reason.
        clamped: cycles in which the limit on the step has held a joint back.

    """

    def __init__(self, parameters: DriverParameters, gravity: Gravity) -> None:
        """Wait for the first packet, wanting nothing.

        Args:
            parameters: of the driver.
            gravity: torques (7,) [Nm] that hold the model at angles (7,) [rad].

        """
        self._parameters = parameters
        self._control = STRATEGIES[parameters.control.strategy]
        self._flags = int(FLAGS[self._control])
        self._handshake = HANDSHAKES[parameters.link.handshake]
        self._fitness = Fitness(
            parameters.link.cycle, parameters.safety, self._control, gravity
        )
        self.sequence = SequenceWatch()
        self.link = LinkEstimate(parameters.link.cycle)
        self.phase = Phase.SILENT
        self.fault = Fault.NONE
        self.cause = ''
        self.unfit = Unfit.NONE
        self.measurement: Measurement | None = None
        self.follower: Follower | None = None
        self.malformed = 0
        self.refused = dict.fromkeys(Refusal, 0)
        self.clamped = 0
        self._wanted = False
        self._since = 0.0
        self._heard = -inf
        self._poor = 0
        self._attempts = 0
        self._sent = 0

    @property
    def commanding(self) -> bool:
        """Tell whether joint commands move the arm."""
        return self.phase is Phase.COMMANDING

    def request(self, wanted: bool) -> None:
        """Ask for command mode, or ask to leave it."""
        if wanted and not self._wanted:
            self._attempts = 0
        self._wanted = wanted

    def reset(self, now: float) -> None:
        """Forget a fault; nothing moves by that, and command mode is begun anew if wanted."""
        if self.phase is not Phase.FAULT:
            return
        self.fault, self.cause = Fault.NONE, ''
        self._attempts = 0
        self._go(Phase.LEAVING, now)

    def command(self, q: ArrayLike, now: float) -> Refusal | None:
        """Head for the joint angles `q` (7,) [rad]; heeded in command mode only."""
        if self.follower is None or not self.commanding:
            return None
        refusal = self.follower.offer(q, now)
        if refusal is not None:
            self.refused[refusal] += 1
        return refusal

    def silence(self, now: float) -> bool:
        """Return whether no packet has come for too long until `now` [s], and act on it."""
        if now - self._heard <= self._parameters.link.time_out:
            return False
        if self.phase in ENGAGED:
            self._break_off(Fault.SILENT, now)
        elif self.phase is not Phase.FAULT:
            self._go(Phase.SILENT, now)
        return True

    def answer(self, data: bytes, now: float) -> bytes | None:
        """Return the answer to a packet that came at `now` [s]; None if it deserves none."""
        try:
            measurement = decode(data)
        except DatagramError:
            self.malformed += 1
            return None
        arrival = self.sequence.judge(measurement.head.sequence)
        if arrival in (Arrival.DUPLICATE, Arrival.OLD):
            return None
        self.measurement, self._heard = measurement, now
        self.link.heard(now, self.sequence.elapsed)
        self.unfit = self._fitness.judge(measurement)
        if arrival is Arrival.RESTARTED and self.phase in ENGAGED:
            self._break_off(Fault.RESTARTED, now)
        self._turn(measurement, now)
        motion = self._motion(measurement, now)
        if motion is None:
            return None
        exchange = self._handshake.exchange(self._control, self._asking)
        answer = encode(self._sent, measurement.head.sequence, exchange, motion)
        self._sent = (self._sent + 1) % WRAP
        return answer

    @property
    def _asking(self) -> bool:
        """Tell whether the KRL program is asked for command mode."""
        return self.phase in (Phase.STARTING, Phase.COMMANDING) or (
            self.phase is Phase.LEAVING and self.follower is not None
            and not self.follower.at_rest
        )

    def _turn(self, measurement: Measurement, now: float) -> None:
        """Go from phase to phase as the controller and the wish allow."""
        state = measurement.interface.state
        match self.phase:
            case Phase.SILENT:
                self._go(Phase.MONITOR, now)
            case Phase.MONITOR if self._wanted:
                self._go(Phase.READYING, now)
            case Phase.READYING:
                self._ready(measurement, now)
            case Phase.STARTING:
                self._start(measurement, now)
            case Phase.COMMANDING:
                self._command(measurement, now)
            case Phase.LEAVING:
                if state is not FriState.COMMAND:
                    self._go(Phase.MONITOR, now)
                elif now - self._since > self._parameters.link.answer_time:
                    self._break_off(Fault.NO_STOP, now)
        if state is not FriState.COMMAND:
            self.follower = None

    def _ready(self, measurement: Measurement, now: float) -> None:
        interface = measurement.interface
        self.unfit |= self._fitness.judge_load(measurement)
        perfect = (
            interface.state is FriState.MONITOR
            and interface.quality is Quality.PERFECT
            and self.link.quality.fit
            and not self.unfit
        )
        if not self._wanted:
            self._go(Phase.MONITOR, now)
        elif not perfect:
            self._since = now
        elif now - self._since >= self._parameters.safety.steady:
            self._attempts += 1
            self._go(Phase.STARTING, now)

    def _start(self, measurement: Measurement, now: float) -> None:
        if self.unfit or not self._wanted:
            self._go(Phase.LEAVING, now)
        elif measurement.interface.state is FriState.COMMAND:
            control = self._parameters.control
            self.follower = Follower(
                self._parameters.guard, measurement.target, control.time_constant,
            )
            self._poor = 0
            if not self._fitness.judge_control(measurement):
                self._go(Phase.COMMANDING, now)
            elif self._attempts < ATTEMPTS:
                self._go(Phase.LEAVING, now)
            else:
                self._break_off(Fault.OTHER_CONTROL, now)
        elif now - self._since > self._parameters.link.answer_time:
            self._break_off(Fault.NO_START, now)

    def _command(self, measurement: Measurement, now: float) -> None:
        safety, follower = self._parameters.safety, self.follower
        assert follower is not None
        self._poor = self._poor + 1 if Unfit.POOR_QUALITY in self.unfit else 0
        grave = self.unfit & ~Unfit.POOR_QUALITY | self._fitness.judge_control(measurement)
        if self._poor > safety.poor_cycles:
            grave |= Unfit.POOR_QUALITY
        if measurement.interface.state is not FriState.COMMAND:
            self._break_off(Fault.FELL_BACK, now, in_words(self.unfit))
        elif grave:
            self.unfit |= grave
            self._break_off(Fault.UNFIT, now, in_words(grave))
        elif follower.watch.silent_for(now) > safety.patience:
            self._break_off(Fault.NO_COMMANDS, now)
        elif not self._wanted:
            self._go(Phase.LEAVING, now)

    def _motion(self, measurement: Measurement, now: float) -> Motion | None:
        """Return what the arm is to do: the motion in command mode, else what it does already."""
        control, interface = self._parameters.control, measurement.interface
        target = measurement.target
        powered = measurement.robot.power & DRIVES_ON
        if interface.state is FriState.COMMAND and powered and self.follower is not None:
            if not self.commanding:
                self.follower.halt()
            share = max(min(control.velocity_share, interface.safety_limits), 0.0)
            target = self.follower.advance(self.sequence.elapsed, now, share)
            self.clamped += self.follower.clamped
        elif not all(map(isfinite, target)):
            return None
        return Motion(
            flags=self._flags,
            joint_position=target,
            joint_stiffness=control.stiffness,
            joint_damping=control.damping,
        )

    def _break_off(self, fault: Fault, now: float, details: str = '') -> None:
        if self.phase is Phase.FAULT:
            return
        self.fault = fault
        self.cause = f'{fault.value}: {details}' if details else fault.value
        self._go(Phase.FAULT, now)

    def _go(self, phase: Phase, now: float) -> None:
        self.phase, self._since = phase, now
