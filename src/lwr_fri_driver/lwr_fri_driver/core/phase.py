# SPDX-License-Identifier: Apache-2.0
"""Where the conversation with the controller is, and why it was broken off."""

from enum import Enum


class Phase(Enum):
    """Where the conversation is."""

    SILENT = 'no packets from the controller'
    MONITOR = 'monitor mode'
    READYING = 'waiting until the controller is fit'
    STARTING = 'waiting for command mode'
    COMMANDING = 'command mode'
    LEAVING = 'leaving command mode'
    FAULT = 'stopped until reset'


ENGAGED = (Phase.STARTING, Phase.COMMANDING, Phase.LEAVING)
"""Phases in which the controller may be in command mode at our wish."""


class Fault(Enum):
    """Why command mode has ended, or was not reached, until reset."""

    NONE = ''
    SILENT = 'the controller has fallen silent'
    RESTARTED = 'the controller has begun anew'
    FELL_BACK = 'the controller has left command mode by itself'
    UNFIT = 'the arm is not fit'
    NO_START = 'the KRL program does not start command mode'
    NO_STOP = 'the KRL program does not end command mode'
    OTHER_CONTROL = 'the KRL program starts another law than was set'
    NO_COMMANDS = 'joint commands have ceased'
