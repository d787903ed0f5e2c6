# SPDX-License-Identifier: Apache-2.0
"""Errors of the tracking package: one base, one class per mistake."""


class TrackingError(Exception):
    """Base of every error that this package raises."""


class PathError(TrackingError, ValueError):
    """Knots that no path can be laid through."""


class ClockError(TrackingError, ValueError):
    """A time that is no finite number."""
