# SPDX-License-Identifier: Apache-2.0
"""Errors of the access package."""


class AccessError(Exception):
    """Base of every error that the package raises; the text is one line for the user."""


class KeyValueError(AccessError, ValueError):
    """A key of the wrong length."""


class KeyFileError(AccessError, ValueError):
    """A key file that others can read, or that holds no key."""


class KeyFileMissingError(AccessError, FileNotFoundError):
    """There is no key file where there should be one."""


class KeyFileExistsError(AccessError, FileExistsError):
    """There is a file where a new key should be written."""


class KeyFileClosedError(AccessError, OSError):
    """The system does not let the key file be read or written."""
