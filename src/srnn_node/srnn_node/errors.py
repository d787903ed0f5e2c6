# SPDX-License-Identifier: Apache-2.0
"""Errors of the node package."""


class NodeError(RuntimeError):
    """A node cannot start or cannot go on; the text says why in one line."""


class SchedulingError(NodeError, ValueError):
    """A real-time priority that no scheduler knows."""


class NotNowError(RuntimeError):
    """What was asked for is not possible now; the text says why in one line."""
