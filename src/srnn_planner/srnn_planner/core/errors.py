# SPDX-License-Identifier: Apache-2.0
"""Errors of the planner's core."""


class SrnnError(Exception):
    """Base of every error that the network, its planning or its learning raises."""


class WeightsError(SrnnError, ValueError):
    """A weight matrix has the wrong size, range or checksum, or is not finite."""


class WeightsFileError(SrnnError, OSError):
    """A weight file is missing or is not a weight file."""


class TaskError(SrnnError, ValueError):
    """Way points that cannot be visited."""


class PairingError(SrnnError, ValueError):
    """A plan and an executed path that do not belong together."""
