# SPDX-License-Identifier: Apache-2.0
"""Errors of this package."""


class ViewError(Exception):
    """Base of all errors of this package."""


class PortError(ViewError, OSError):
    """The page cannot be served at the port that was asked for."""
