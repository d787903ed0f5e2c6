# SPDX-License-Identifier: Apache-2.0
"""Errors of the bring-up."""


class BringupError(Exception):
    """Base of every error that the bring-up raises; the text is one line for the user."""


class ConfigDirectoryError(BringupError, FileNotFoundError):
    """The configuration files are in none of the places where they may be."""


class ChoiceError(BringupError, ValueError):
    """The user asks for something that does not exist or does not go together."""


class NodeDiedError(BringupError, ChildProcessError):
    """A node of the graph has ended although nobody asked it to."""


class TransitionError(BringupError, RuntimeError):
    """A node refuses a transition of its lifecycle."""


class NotReadyError(BringupError, TimeoutError):
    """Something did not happen within the time it may take."""


class KeystoreError(BringupError, OSError):
    """A keystore cannot be made there, or lacks something."""


class SecurityError(BringupError, PermissionError):
    """The middleware does not protect the graph, or does not let it in."""


class Interrupted(BringupError):  # noqa: N818  # a wish, not a mistake
    """The user asked to stop; the text is the name of the signal."""
