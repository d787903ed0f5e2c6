# SPDX-License-Identifier: Apache-2.0
"""Errors of the arm description: one base, one class per mistake."""

from srnn_config import ConfigError


class DescriptionError(Exception):
    """Base of every error that the arm description raises."""


class UnreachableError(DescriptionError, ValueError):
    """No joint position inside the limits puts the tip where it was asked to be."""


class MissingModelError(DescriptionError, ConfigError):
    """The model file of an arm is not where its description says."""


class ModelError(DescriptionError, ConfigError):
    """The model file of an arm does not hold the arm that its description says."""
