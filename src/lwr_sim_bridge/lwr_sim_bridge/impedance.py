# SPDX-License-Identifier: Apache-2.0
"""Joint impedance law of the arm's own controller."""

import numpy as np
from numpy.typing import NDArray

from lwr_sim_bridge.parameters import ImpedanceParameters

Array = NDArray[np.float64]


def impedance_of(parameters: ImpedanceParameters) -> tuple[Array, Array]:
    """Return stiffness (n,) [Nm/rad] and damping ratio (n,) of the joints."""
    stiffness = np.array(parameters.stiffness)
    return stiffness, np.full(len(stiffness), parameters.damping_ratio)


class JointImpedance:
    """tau = K (q_d - q) + D (v_d - v) + g(q), clamped to the torque limits.

    D_i = 2 zeta sqrt(K_i M_ii) gives joint i, moving alone, the damping ratio zeta
    (Albu-Schaeffer, Ott and Hirzinger 2007, with the diagonal of M for the whole).
    """

    def __init__(self, stiffness: Array, damping_ratio: Array, torque_max: Array) -> None:
        """Take what `set` takes, and torque limits (n,) [Nm]; call `adapt` before `torque`."""
        self._torque_max = torque_max
        self.set(stiffness, damping_ratio)
        self._damping = np.zeros(len(stiffness))
        self._torque = np.empty(len(stiffness))
        self._scratch = np.empty(len(stiffness))

    def set(self, stiffness: Array, damping_ratio: Array) -> None:
        """Change the law; the damping follows in the next call of `adapt`.

        Args:
            stiffness: (n,) K [Nm/rad].
            damping_ratio: (n,) zeta.

        """
        self._stiffness, self._ratio = stiffness.copy(), damping_ratio.copy()

    def adapt(self, mass: Array) -> None:
        """Fit the damping to the joint-space inertia `mass` (n, n) [kg m^2]."""
        self._damping = 2.0 * self._ratio * np.sqrt(self._stiffness * mass.diagonal())

    def torque(self, q: Array, v: Array, q_desired: Array, v_desired: Array, g: Array) -> Array:
        """Return the joint torques (n,) [Nm]; the array is overwritten by the next call.

        Args:
            q: (n,) joint angles [rad].
            v: (n,) joint velocities [rad/s].
            q_desired: (n,) desired angles [rad].
            v_desired: (n,) desired velocities [rad/s].
            g: (n,) gravity torques of the nominal arm [Nm].

        """
        torque, scratch = self._torque, self._scratch
        np.subtract(q_desired, q, out=torque)
        torque *= self._stiffness
        np.subtract(v_desired, v, out=scratch)
        scratch *= self._damping
        torque += scratch
        torque += g
        np.minimum(torque, self._torque_max, out=torque)
        return np.maximum(torque, -self._torque_max, out=torque)
