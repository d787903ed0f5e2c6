# SPDX-License-Identifier: Apache-2.0
"""The arm's own controller and torque observer around the plant: the plain NumPy reference."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_guard.interpolator import Interpolator
from lwr_sim_bridge.impedance import JointImpedance, impedance_of
from lwr_sim_bridge.momentum_observer import MomentumObserver
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.plant import Plant
from lwr_sim_bridge.scene_model import SceneModel

Array = NDArray[np.float64]


class ControlLoop:
    """Interpolator, impedance law and momentum observer know the nominal arm alone."""

    def __init__(
        self, parameters: ArmParameters, kinematics: Kinematics, scene: SceneModel, tick: float
    ) -> None:
        """Hold the plant, which is at rest, where it is.

        Args:
            parameters: of the arm.
            kinematics: the nominal arm.
            scene: the plant.
            tick: time step of the plant [s].

        """
        self._scene = scene
        self._plant = Plant.of(scene.model, scene.data)
        q = self._plant.state.q
        mass = kinematics.mass_matrix(q)
        self._kinematics = kinematics
        self._interpolator = Interpolator(q, parameters.command.time_constant, tick)
        self._impedance = JointImpedance(
            *impedance_of(parameters.impedance), kinematics.limits.torque_max
        )
        self._impedance.adapt(mass)
        self._observer = MomentumObserver(parameters.observer.gain, mass, np.zeros(len(q)))
        self._ticks_per_estimate = parameters.observer.ticks
        self._tick = tick
        self._ticks = 0
        self._torque_sum = np.zeros(len(q))
        self._plant.torque[:] = kinematics.gravity(q)

    @property
    def residual(self) -> Array:
        """Estimated external torques (n,) [Nm]."""
        return self._observer.residual

    def head_for(self, q: Array) -> None:
        """Take the joint angles `q` (n,) [rad] as the command from the next tick on."""
        self._interpolator.command(q)

    def set_impedance(self, stiffness: Array, damping_ratio: Array) -> None:
        """Take stiffness (n,) [Nm/rad] and damping ratio (n,) of the joints from now on."""
        self._impedance.set(stiffness, damping_ratio)

    def run(self, ticks: int, noise: Array) -> int:
        """Advance until the simulator warns, the tool touches something or time is up.

        Args:
            ticks: at most so many.
            noise: (m, 3, n) of angles [rad], velocities [rad/s] and torques [Nm] in the
                next m estimates, at least as many as there will be; may be overwritten.

        Returns:
            How many ticks it were, the one with the warning or the contact included.

        """
        estimates = 0
        for done in range(1, ticks + 1):
            self._control()
            mujoco.mj_step(self._scene.model, self._scene.data)
            self._ticks += 1
            if self._plant.warnings.any():
                return done
            if self._ticks % self._ticks_per_estimate == 0:
                self._observe(noise[estimates])
                estimates += 1
            if self._scene.data.ncon:
                return done
        return ticks

    def measure(self, noise: Array) -> tuple[Array, Array, Array]:
        """Return what the arm measures now: angles, velocities and torques, (n,) each.

        Args:
            noise: (3, n) of these, [rad], [rad/s] and [Nm]; may be overwritten.

        """
        state = self._plant.state
        return noise[0] + state.q, noise[1] + state.v, noise[2] + self._plant.torque

    def _control(self) -> None:
        state, desired = self._plant.state, self._interpolator
        desired.step()
        gravity = self._kinematics.gravity(state.q)
        torque = self._impedance.torque(
            state.q, state.v, desired.position, desired.velocity, gravity
        )
        self._plant.torque[:] = torque
        self._torque_sum += torque

    def _observe(self, noise: Array) -> None:
        position = noise[0] + self._plant.state.q
        velocity = noise[1] + self._plant.state.v
        torque = noise[2] + self._torque_sum / self._ticks_per_estimate
        mass, bias = self._kinematics.mass_and_bias(position, velocity)
        bias += self._plant.damping * velocity
        elapsed = self._ticks_per_estimate * self._tick
        self._observer.update(mass, velocity, bias, torque, elapsed)
        self._impedance.adapt(mass)
        self._torque_sum[:] = 0.0
