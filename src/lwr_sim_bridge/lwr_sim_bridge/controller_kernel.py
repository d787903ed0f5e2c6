# SPDX-License-Identifier: Apache-2.0
"""The compiled controller: what `controller.Controller` does, with fewer calls."""

import numba
import numpy as np
from numpy.typing import NDArray

from lwr_description import DOF, TORQUE_MAX, Kinematics
from lwr_description.handle import Handle
from lwr_description.kinematics_kernel import gravity_at, mass_and_bias_at
from lwr_sim_bridge.interpolator import transition
from lwr_sim_bridge.parameters import ArmParameters

Array = NDArray[np.float64]


class Controller:
    """See `controller.Controller`; after the constructor nothing is compiled any more."""

    def __init__(
        self,
        parameters: ArmParameters,
        kinematics: Kinematics,
        plant: Handle,
        friction: Array,
        tick: float,
    ) -> None:
        """See `controller.Controller`."""
        self.torque: Array = kinematics.gravity(plant.q)
        self.residual: Array = np.zeros(DOF)
        self._kinematics = kinematics  # Whose scratch memory the arguments below are.
        self._command = plant.q.copy()
        desired = np.array([plant.q, np.zeros(DOF)])
        mass = kinematics.mass_matrix(plant.q)
        stiffness = np.array(parameters.impedance.stiffness)
        ratio, ticks = parameters.impedance.damping_ratio, parameters.observer.ticks
        damping, torque_sum = np.empty(DOF), np.zeros(DOF)
        _adapt(damping, stiffness, ratio, mass)
        self._step_arguments = (
            plant.q, plant.v, kinematics.still, TORQUE_MAX,
            transition(parameters.command.time_constant, tick), self._command, desired,
            stiffness, damping, self.torque, torque_sum,
        )  # fmt: skip
        self._observe_arguments = (
            plant.q, plant.v, kinematics.moving, friction.copy(), parameters.observer.gain,
            ticks, ticks * tick, stiffness, ratio, damping, torque_sum, mass, np.zeros(DOF),
            self.residual,
        )  # fmt: skip
        self._warm_up()

    def head_for(self, q: Array) -> None:
        """See `controller.Controller`."""
        self._command[:] = q

    def step(self) -> None:
        """See `controller.Controller`."""
        _step(*self._step_arguments)

    def observe(self, noise: Array) -> None:
        """See `controller.Controller`; `noise` is overwritten."""
        _observe(noise, *self._observe_arguments)

    def _warm_up(self) -> None:
        """Compile for the types of the arguments, or load what has been compiled."""
        _step.compile(tuple(map(numba.typeof, self._step_arguments)))
        noise = np.empty((3, DOF))
        _observe.compile(tuple(map(numba.typeof, (noise, *self._observe_arguments))))


@numba.njit(cache=True)
def _step(
    q, v, still, limit, transition, command, desired, stiffness, damping, torque, torque_sum
):
    gravity_at(still, q, torque)
    for i in range(q.shape[0]):
        position, velocity = desired[0, i], desired[1, i]
        for k in range(2):
            desired[k, i] = (
                transition[k, 0] * position
                + transition[k, 1] * velocity
                + transition[k, 2] * command[i]
            )
        spring = (desired[0, i] - q[i]) * stiffness[i]
        total = spring + (desired[1, i] - v[i]) * damping[i] + torque[i]
        torque[i] = max(min(total, limit[i]), -limit[i])
        torque_sum[i] += torque[i]


@numba.njit(cache=True)
def _observe(
    noise, q, v, moving, friction, gain, ticks, elapsed, stiffness, ratio, damping, torque_sum,
    mass_before, velocity_before, residual,
):
    position, velocity, torque = noise[0], noise[1], noise[2]
    position += q
    velocity += v
    torque += torque_sum / ticks
    mass, bias = np.empty_like(mass_before), np.empty_like(residual)
    mass_and_bias_at(moving, position, velocity, mass, bias)
    for i in range(residual.shape[0]):
        inertial = 0.0
        for k in range(residual.shape[0]):
            inertial += (mass[i, k] + mass_before[i, k]) * (velocity[k] - velocity_before[k])
        bias[i] += friction[i] * velocity[i]
        external = 0.5 * inertial + (bias[i] - torque[i]) * elapsed
        residual[i] = (residual[i] + gain * external) / (1.0 + gain * elapsed)
    _adapt(damping, stiffness, ratio, mass)
    mass_before[:] = mass
    velocity_before[:] = velocity
    torque_sum[:] = 0.0


@numba.njit(cache=True)
def _adapt(damping, stiffness, ratio, mass):
    for i in range(damping.shape[0]):
        damping[i] = 2.0 * ratio * np.sqrt(stiffness[i] * mass[i, i])
