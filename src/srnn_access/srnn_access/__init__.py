# SPDX-License-Identifier: Apache-2.0
"""Who may command the arm: keys, marks, seals, and the rules of whoever receives."""

from srnn_access.custody import Custody
from srnn_access.errors import AccessError
from srnn_access.key import Key
from srnn_access.mark import Mark
from srnn_access.refusal import Refusal
from srnn_access.seal import Seal
from srnn_access.source import Source

__all__ = ['AccessError', 'Custody', 'Key', 'Mark', 'Refusal', 'Seal', 'Source']
