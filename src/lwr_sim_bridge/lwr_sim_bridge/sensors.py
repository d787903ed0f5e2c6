# SPDX-License-Identifier: Apache-2.0
"""Measurement noise of the simulated arm."""

import numpy as np
from numpy.typing import NDArray

from lwr_description import DOF
from lwr_sim_bridge.parameters import NoiseParameters
from srnn_config.scene import SceneNoise

Array = NDArray[np.float64]


class Sensors:
    """Adds white noise, drawn afresh at every reading."""

    def __init__(
        self, scene: SceneNoise, parameters: NoiseParameters, rng: np.random.Generator
    ) -> None:
        """Take the standard deviations from the scene and from the arm's parameters."""
        deviations = [scene.position, parameters.velocity, scene.torque]
        self._deviations = parameters.scale * np.repeat(deviations, DOF).reshape(3, DOF)
        self._rng = rng

    def noise(self, readings: int) -> Array:
        """Return what readings add to angles, velocities and torques, (readings, 3, 7)."""
        noise = self._rng.standard_normal((readings, 3, DOF))
        noise *= self._deviations
        return noise

    def read(self, q: Array, v: Array, torque: Array) -> Array:
        """Return measured angles [rad], velocities [rad/s] and torques [Nm], (3, 7)."""
        measured: Array = self.noise(1)[0]
        measured[0] += q
        measured[1] += v
        measured[2] += torque
        return measured
