# SPDX-License-Identifier: Apache-2.0
"""Driver and emulated controller, cycle by cycle in one thread, with a network between them."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from lwr_description import VELOCITY_MAX, Kinematics, Mount
from lwr_fri_driver.core.connection import Connection
from lwr_fri_driver.core.parameters import DriverParameters
from lwr_fri_driver.core.phase import Phase
from lwr_sim_bridge.fri.controller import COMMAND, DRIVES_ON, FriController
from lwr_sim_bridge.fri.krl_program import KrlProgram
from lwr_sim_bridge.fri.link_faults import LinkFaults
from lwr_sim_bridge.fri.parameters import ControllerParameters, LinkFaultParameters
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.simulated_arm import SimulatedArm
from srnn_config.scene import Scene, SceneTask

MOUNT = Mount()
PROCESSING = 0.0002
"""Time that the driver takes for an answer [s]."""

FREE = Scene(SceneTask('free'), waypoints=((0.0, 0.0),))
NO_FAULTS = LinkFaultParameters()


class FriWorld:
    """Time goes on in milliseconds; `run` lets some of it pass.

    Attributes:
        now: time [s].
        controller: the emulated one.
        connection: the driver's.
        joints: where the arm was at the end of each cycle, (7,) [rad].
        answers: joint angles of every answer, (7,) [rad], and whether they counted.
        phases: in which the driver was, in order, without repetitions.
        silent: whether the controller keeps quiet.

    """

    def __init__(self, scene=FREE, parameters=None, cycle=5, seed=1, handshake='fri_library',
                 emulator=None):
        parameters = parameters or DriverParameters()
        link = replace(parameters.link, cycle=1e-3 * cycle, handshake=handshake)
        self.parameters = replace(parameters, link=link)
        self.cycle = cycle
        self.now = 100.0
        self.silent = False
        self.joints, self.answers, self.phases = [], [], [Phase.SILENT]
        self._scene, self._handshake = scene, handshake
        self._emulator = emulator or ControllerParameters()
        self._rng = np.random.default_rng(seed)
        self._kinematics = Kinematics(MOUNT)
        self.set_faults(NO_FAULTS)
        self.start_controller()
        self.connection = Connection(self.parameters, self._kinematics.gravity)

    def set_faults(self, faults):
        self._up = LinkFaults(faults, self._rng)
        self._down = LinkFaults(faults, self._rng)

    def start_controller(self):
        """Switch on a controller that knows nothing of the one before."""
        arm = SimulatedArm(ArmParameters(), MOUNT, self._scene, self._rng)
        self.controller = FriController(
            arm, MOUNT, self.cycle, KrlProgram(self._handshake), self._emulator
        )

    @property
    def phase(self):
        return self.connection.phase

    @property
    def tip(self):
        return self.controller.arm.tip_truth

    def run(self, seconds, command=None, until=None):
        """Let time pass; `command` (now) returns joint angles or None, once in a cycle.

        Returns:
            Whether `until` () held before the time was over.

        """
        for _ in range(round(1e3 * seconds / self.cycle)):
            if until is not None and until():
                return True
            if command is not None:
                q = command(self.now)
                if q is not None:
                    self.connection.command(q, self.now)
            self._cycle()
        return until is not None and until()

    def to_command_mode(self):
        self.connection.request(True)
        assert self.run(6.0, until=lambda: self.connection.commanding), self.connection.cause

    def swing(self, seconds, joint=3, amplitude=0.1, frequency=0.5):
        """Have a joint swing about where it is told to be now."""
        middle, begin = self.controller.target.copy(), self.now

        def command(now):
            q = middle.copy()
            # It begins at rest.
            phase = 2.0 * np.pi * frequency * (now - begin)
            q[joint] += 0.5 * amplitude * (1.0 - np.cos(phase))
            return q

        self.run(seconds, command)

    def moved(self, since=0):
        """Return the longest way of a joint in a cycle after number `since` [rad]."""
        return float(np.abs(np.diff(self.joints[since:], axis=0)).max())

    def longest_step(self):
        """Return the longest step between answers in a row, over the limits (7,), as a share."""
        limit = VELOCITY_MAX * 1e-3 * self.cycle * self.parameters.control.velocity_share
        steps = [
            np.abs(after - before) / limit
            for (before, _), (after, counts) in pairwise(self.answers) if counts
        ]
        return float(np.max(steps))

    def _cycle(self):
        if not self.silent:
            self._up.take(self.controller.measure(), self.now)
            self.controller.sent(self.now)
        for _ in range(self.cycle):
            self.now += 0.001
            self._exchange()
        if not self.silent:
            self.controller.advance()
        self.joints.append(self.controller.arm.data.qpos.copy())

    def _exchange(self):
        """Let the packets of the last millisecond arrive."""
        for packet, arrival in self._up.arrived(self.now):
            answer = self.connection.answer(packet, arrival)
            if answer is not None:
                self.connection.link.answered(PROCESSING)
                counts = self.controller.state == COMMAND and self.controller.power == DRIVES_ON
                self.answers.append((np.frombuffer(answer[144:172], '<f4'), counts))
                self._down.take(answer, arrival + PROCESSING)
        for packet, arrival in self._down.arrived(self.now):
            self.controller.receive(packet, arrival)
        self.connection.silence(self.now)
        if self.phases[-1] is not self.phase:
            self.phases.append(self.phase)
