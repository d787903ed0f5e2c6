# SPDX-License-Identifier: Apache-2.0
"""A controller that says what a test wants, in bytes written by hand, and obeys at once."""

import struct

from golden import COMMAND, MEASUREMENT, put
import numpy as np

from lwr_fri_driver.core.connection import Connection
from lwr_fri_driver.core.parameters import DriverParameters

HOME = [0.0, -0.5, 0.25, 1.5, 0.0, 0.5, 0.0]
CYCLE = 0.005

BITS = np.spacing(np.float32(4.0))
"""Single precision of an angle [rad]."""

NAMES = {name.rpartition('.')[2]: name for name in MEASUREMENT}

OFF, MONITOR, COMMANDING = 0, 1, 2
POSITION, IMPEDANCE = 1, 3


def no_gravity(q):
    return np.zeros(7)


class Answer:
    """A command, read byte by byte."""

    def __init__(self, data):
        assert len(data) == 376
        self._data = data

    def __getitem__(self, name):
        offset, code, count = COMMAND[name]
        values = struct.unpack_from(f'<{count}{code}', self._data, offset)
        return np.array(values) if count > 1 else values[0]

    @property
    def position(self):
        return self['motion.joint_position']

    @property
    def ints(self):
        return self['exchange.ints']


class ScriptedController:
    """`say` sets fields of the next measurement; `cycle` sends it and returns the answer."""

    def __init__(self, parameters=None):
        self.connection = Connection(parameters or DriverParameters(), no_gravity)
        self.now = 100.0
        self.sequence = 0
        self._data = bytearray(916)
        for name, values in {
            'head.size': [916], 'head.datagram_id': [0x2006],
            'interface.state': [MONITOR], 'interface.quality': [3],
            'interface.measurement_period': [CYCLE], 'interface.command_period': [CYCLE],
            'interface.safety_limits': [1.0], 'robot.power': [0x7F], 'robot.control': [IMPEDANCE],
            'data.joint_position': HOME, 'data.commanded_joint_position': HOME,
        }.items():  # fmt: skip
            put(self._data, MEASUREMENT, name, *values)

    def datagram(self):
        put(self._data, MEASUREMENT, 'head.sequence', self.sequence % 65536)
        return bytes(self._data)

    def cycle(self, **says):
        """Let a cycle pass and send a measurement; return the answer, or None."""
        self.say(**says)
        self.now += CYCLE
        self.sequence += 1
        answer = self.connection.answer(self.datagram(), self.now)
        if answer is not None:
            self.connection.link.answered(0.0001)
        return None if answer is None else Answer(answer)

    def say(self, **says):
        for name, value in says.items():
            put(self._data, MEASUREMENT, NAMES[name], *np.atleast_1d(value))

    def cycles(self, seconds, **says):
        answers = [self.cycle(**says) for _ in range(round(seconds / CYCLE))]
        return answers[-1]

    def obey(self, answer):
        """Head for where the answer says, and be there."""
        self.say(commanded_joint_position=answer.position, joint_position=answer.position)

    def to_command_mode(self):
        self.connection.request(True)
        self.cycles(1.1)
        assert self.cycle().ints[1] == 1
        answer = self.cycle(state=COMMANDING)
        assert self.connection.commanding
        return answer
