# SPDX-License-Identifier: Apache-2.0
"""Errors of the simulated arm: one base, one class per mistake."""


class BridgeError(Exception):
    """Base of every error that the simulated arm raises."""


class SceneShapeError(BridgeError, ValueError):
    """An obstacle has a shape that the simulator cannot build."""


class SimulationError(BridgeError, RuntimeError):
    """The physics has gone wrong; what the simulator says is no longer an arm."""
