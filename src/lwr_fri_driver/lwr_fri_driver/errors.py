# SPDX-License-Identifier: Apache-2.0
"""Errors of the driver: one base, one class per mistake."""


class FriError(Exception):
    """Base of every error that this package raises."""


class DatagramError(FriError, ValueError):
    """A packet that is no FRI datagram of this version, or a value that fits into none."""


class LoopError(FriError, RuntimeError):
    """The process that answers the controller cannot start, or has ended."""
