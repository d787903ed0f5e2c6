# SPDX-License-Identifier: Apache-2.0
"""Errors of the arm description: one base, one class per mistake."""


class DescriptionError(Exception):
    """Base of every error that the arm description raises."""


class UnreachableError(DescriptionError, ValueError):
    """No joint position inside the limits puts the tip where it was asked to be."""
