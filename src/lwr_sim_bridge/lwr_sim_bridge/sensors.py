# SPDX-License-Identifier: Apache-2.0
"""Measurement noise of the simulated arm."""

import numpy as np
from numpy.typing import NDArray

from lwr_sim_bridge.parameters import NoiseParameters
from srnn_config.scene import SceneNoise

Array = NDArray[np.float64]

_BLOCK = 64
"""Readings whose noise is drawn together: a call of the generator is dear."""


class Sensors:
    """Adds white noise, fresh in every reading."""

    def __init__(
        self,
        scene: SceneNoise,
        parameters: NoiseParameters,
        joints: int,
        rng: np.random.Generator,
    ) -> None:
        """Take the standard deviations from the scene and from the arm's parameters.

        Args:
            scene: noise that the scene sets.
            parameters: further noise.
            joints: their number.
            rng: source of all noise.

        """
        deviations = [scene.position, parameters.velocity, scene.torque]
        self._deviations = parameters.scale * np.repeat(deviations, joints).reshape(3, joints)
        self._rng = rng
        self._drawn = np.empty((0, 3, joints))
        self._used = 0

    def noise(self, readings: int) -> Array:
        """Return what readings add to the truth, (readings, 3, n).

        Angles [rad], velocities [rad/s] and torques [Nm]; nobody else gets the same array.
        """
        if self._used + readings > len(self._drawn):
            shape = (max(_BLOCK, readings), *self._deviations.shape)
            fresh = self._rng.standard_normal(shape) * self._deviations
            self._drawn = np.concatenate((self._drawn[self._used:], fresh))
            self._used = 0
        begin, self._used = self._used, self._used + readings
        return self._drawn[begin:self._used]
