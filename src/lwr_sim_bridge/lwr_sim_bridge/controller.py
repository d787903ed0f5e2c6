# SPDX-License-Identifier: Apache-2.0
"""The arm's own controller and torque observer: the plain NumPy reference."""

import numpy as np
from numpy.typing import NDArray

from lwr_description import DOF, Kinematics
from lwr_description.handle import Handle
from lwr_sim_bridge.impedance import JointImpedance
from lwr_sim_bridge.interpolator import Interpolator
from lwr_sim_bridge.momentum_observer import MomentumObserver
from lwr_sim_bridge.parameters import ArmParameters

Array = NDArray[np.float64]


class Controller:
    """Interpolator, impedance law and momentum observer around the nominal arm.

    Attributes:
        torque: (7,) joint torques of the last tick [Nm]; a view that `step` changes.
        residual: (7,) estimated external torques [Nm]; a view that `observe` changes.

    """

    def __init__(
        self,
        parameters: ArmParameters,
        kinematics: Kinematics,
        plant: Handle,
        friction: Array,
        tick: float,
    ) -> None:
        """Hold the plant, which is at rest, where it is.

        Args:
            parameters: of the arm.
            kinematics: the nominal arm.
            plant: what is measured.
            friction: (7,) known viscous friction [Nm s/rad].
            tick: time between two calls of `step` [s].

        """
        mass = kinematics.mass_matrix(plant.q)
        self._kinematics = kinematics
        self._plant = plant
        self._friction = friction.copy()
        self._ticks = parameters.observer.ticks
        self._elapsed = parameters.observer.ticks * tick
        self._interpolator = Interpolator(plant.q, parameters.command.time_constant, tick)
        self._impedance = JointImpedance(parameters.impedance)
        self._impedance.adapt(mass)
        self._observer = MomentumObserver(parameters.observer.gain, mass, np.zeros(DOF))
        self._torque_sum = np.zeros(DOF)
        self.torque: Array = kinematics.gravity(plant.q)

    @property
    def residual(self) -> Array:
        """Estimated external torques (7,) [Nm]."""
        return self._observer.residual

    def head_for(self, q: Array) -> None:
        """Take the joint angles `q` (7,) [rad] as the command from the next tick on."""
        self._interpolator.command(q)

    def step(self) -> None:
        """Compute the torque of one tick."""
        q, v, desired = self._plant.q, self._plant.v, self._interpolator
        desired.step()
        gravity = self._kinematics.gravity(q)
        self.torque = self._impedance.torque(q, v, desired.position, desired.velocity, gravity)
        self._torque_sum += self.torque

    def observe(self, noise: Array) -> None:
        """Estimate external torques; to be called after every so many ticks.

        Args:
            noise: (3, 7) of angles [rad], velocities [rad/s] and torques [Nm].

        """
        position = noise[0] + self._plant.q
        velocity = noise[1] + self._plant.v
        torque = noise[2] + self._torque_sum / self._ticks
        mass, bias = self._kinematics.mass_and_bias(position, velocity)
        bias += self._friction * velocity
        self._observer.update(mass, velocity, bias, torque, self._elapsed)
        self._impedance.adapt(mass)
        self._torque_sum[:] = 0.0
