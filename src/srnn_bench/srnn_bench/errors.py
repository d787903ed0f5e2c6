# SPDX-License-Identifier: Apache-2.0
"""Errors of the bench."""


class BenchError(Exception):
    """Base of every error that the bench raises; the text is one line for the user."""


class ChoiceError(BenchError, ValueError):
    """A row that there is not was asked for."""


class TaskError(BenchError, ValueError):
    """A task that nobody can do was asked for."""


class PeerError(BenchError, ChildProcessError):
    """A process in which a peer runs has failed."""
