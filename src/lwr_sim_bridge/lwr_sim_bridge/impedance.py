# SPDX-License-Identifier: Apache-2.0
"""Joint impedance law of the LWR's own controller."""

import numpy as np
from numpy.typing import NDArray

from lwr_description import DOF, TORQUE_MAX
from lwr_sim_bridge.parameters import ImpedanceParameters

Array = NDArray[np.float64]


def impedance_of(parameters: ImpedanceParameters) -> tuple[Array, Array]:
    """Return stiffness (7,) [Nm/rad] and damping ratio (7,) of the joints."""
    return np.array(parameters.stiffness), np.full(DOF, parameters.damping_ratio)


class JointImpedance:
    """tau = K (q_d - q) + D (v_d - v) + g(q), clamped to the torque limits.

    D_i = 2 zeta sqrt(K_i M_ii) gives joint i, moving alone, the damping ratio zeta
    (Albu-Schaeffer, Ott and Hirzinger 2007, with the diagonal of M for the whole).
    """

    def __init__(self, stiffness: Array, damping_ratio: Array) -> None:
        """Take what `set` takes; call `adapt` before `torque`."""
        self.set(stiffness, damping_ratio)
        self._damping = np.zeros(DOF)
        self._torque = np.empty(DOF)
        self._scratch = np.empty(DOF)

    def set(self, stiffness: Array, damping_ratio: Array) -> None:
        """Change the law; the damping follows in the next call of `adapt`.

        Args:
            stiffness: (7,) K [Nm/rad].
            damping_ratio: (7,) zeta.

        """
        self._stiffness, self._ratio = stiffness.copy(), damping_ratio.copy()

    def adapt(self, mass: Array) -> None:
        """Fit the damping to the joint-space inertia `mass` (7, 7) [kg m^2]."""
        self._damping = 2.0 * self._ratio * np.sqrt(self._stiffness * mass.diagonal())

    def torque(self, q: Array, v: Array, q_desired: Array, v_desired: Array, g: Array) -> Array:
        """Return the joint torques (7,) [Nm]; the array is overwritten by the next call.

        Args:
            q: (7,) joint angles [rad].
            v: (7,) joint velocities [rad/s].
            q_desired: (7,) desired angles [rad].
            v_desired: (7,) desired velocities [rad/s].
            g: (7,) gravity torques of the nominal arm [Nm].

        """
        torque, scratch = self._torque, self._scratch
        np.subtract(q_desired, q, out=torque)
        torque *= self._stiffness
        np.subtract(v_desired, v, out=scratch)
        scratch *= self._damping
        torque += scratch
        torque += g
        np.minimum(torque, TORQUE_MAX, out=torque)
        return np.maximum(torque, -TORQUE_MAX, out=torque)
