# SPDX-License-Identifier: Apache-2.0
"""Estimate of external joint torques from the generalised momentum."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class MomentumObserver:
    """r' = K (tau_ext - r): a first-order low-pass of the external torque, per joint.

    De Luca, Albu-Schaeffer, Haddadin and Hirzinger 2006:
    r = K [p - p(0) - integral (tau + C' v - g + r) dt] with p = M(q) v. With C' v - g =
    Mdot v - (C v + g) it needs no acceleration. Implicit in r, so stable for every gain.

    Attributes:
        residual: (n,) estimated external torque r [Nm].

    """

    def __init__(self, gain: float, mass: Array, velocity: Array) -> None:
        """Start with r = 0.

        Args:
            gain: K [1/s].
            mass: (n, n) joint-space inertia now [kg m^2].
            velocity: (n,) joint velocities now [rad/s].

        """
        self._gain = gain
        self._mass = mass
        self._velocity = velocity
        self.residual: Array = np.zeros(len(velocity))

    def update(
        self, mass: Array, velocity: Array, bias: Array, torque: Array, elapsed: float
    ) -> None:
        """Take in what was measured since the last update.

        The momentum's change less that of the mass matrix is, at the mid-point, exactly
        mean(M) times the change of v.

        Args:
            mass: (n, n) inertia at the end of the interval [kg m^2]; kept, not copied.
            velocity: (n,) velocities at its end [rad/s]; kept, not copied.
            bias: (n,) C v + g and known friction in the interval [Nm].
            torque: (n,) mean joint torque of the interval [Nm].
            elapsed: length of the interval [s].

        """
        inertial = (mass + self._mass) @ (velocity - self._velocity)
        inertial *= 0.5
        external = inertial + (bias - torque) * elapsed
        self.residual = (self.residual + self._gain * external) / (1.0 + self._gain * elapsed)
        self._mass = mass
        self._velocity = velocity
