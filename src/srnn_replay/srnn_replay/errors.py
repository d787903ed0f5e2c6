# SPDX-License-Identifier: Apache-2.0
"""Errors of the replay."""

FROM_THE_START = 'record from the start with --record'
"""What helps who has begun to record too late."""


class ReplayError(Exception):
    """Base of every error that the package raises; the text is one line for the user."""


class NotReplayableError(ReplayError, ValueError):
    """A bag lacks what its decisions could be made again from."""


class OtherVersionError(ReplayError, ValueError):
    """A bag was recorded by other code, or on other libraries, than would replay it."""
