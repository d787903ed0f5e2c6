# SPDX-License-Identifier: Apache-2.0
"""Errors of the experiments package."""


class ExperimentError(Exception):
    """Base of all errors of this package."""


class SceneError(ExperimentError, ValueError):
    """A scene that cannot be made or cannot be solved."""


class StoreError(ExperimentError, ValueError):
    """A file of finished trials that belongs to something else."""


class SchedulerError(ExperimentError, RuntimeError):
    """Trials cannot be sent to workers, or were lost there."""
