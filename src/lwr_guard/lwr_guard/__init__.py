# SPDX-License-Identifier: Apache-2.0
"""What the side of the arm checks of every joint command, whoever sends it."""

from lwr_guard.command_gate import CommandGate, Refusal
from lwr_guard.command_watch import CommandWatch
from lwr_guard.parameters import GuardParameters

__all__ = ['CommandGate', 'CommandWatch', 'GuardParameters', 'Refusal']
