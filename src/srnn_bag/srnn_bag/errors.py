# SPDX-License-Identifier: Apache-2.0
"""Errors of the bag package."""


class BagError(Exception):
    """Base of every error that the package raises; the text is one line for the user."""


class BagMissingError(BagError, FileNotFoundError):
    """There is no bag where one should be read."""


class BagExistsError(BagError, FileExistsError):
    """There is something where a new bag should be written."""


class BagFormatError(BagError, ValueError):
    """A file is no bag, or damaged beyond what a killed recorder leaves behind."""


class UnknownTypeError(BagError, LookupError):
    """No installed package defines a message type."""
