# SPDX-License-Identifier: Apache-2.0
"""The compiled control loop: what `control_loop.ControlLoop` does, many ticks in one call."""

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

from lwr_description import Kinematics
from lwr_description.compiled import compiled
from lwr_description.handle import Handle
from lwr_description.kinematics_kernel import gravity_at, mass_and_bias_at
from lwr_description.mujoco_c import mj_step
from lwr_guard.interpolator import transition
from lwr_sim_bridge.impedance import impedance_of
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.plant import Plant
from lwr_sim_bridge.scene_model import SceneModel

Array = NDArray[np.float64]


class _Settings(NamedTuple):
    still: Handle
    moving: Handle
    transition: Array
    torque_max: Array
    stiffness: Array
    damping_ratio: Array
    gain: float
    ticks_per_estimate: int
    tick: float


class _Memory(NamedTuple):
    """What the loop remembers from tick to tick; shapes (n,) but for `mass`, (n, n)."""

    command: Array
    position: Array
    velocity: Array
    damping: Array
    torque_sum: Array
    mass: Array
    measured_velocity: Array
    residual: Array


class ControlLoop:
    """See `control_loop.ControlLoop`; after the constructor nothing is compiled any more."""

    def __init__(
        self, parameters: ArmParameters, kinematics: Kinematics, scene: SceneModel, tick: float
    ) -> None:
        """See `control_loop.ControlLoop`."""
        self._owners = kinematics, scene  # Of what the kernel has the addresses of.
        self._plant = Plant.of(scene.model, scene.data)
        self._settings = _Settings(
            kinematics.still,
            kinematics.moving,
            transition(parameters.command.time_constant, tick),
            kinematics.limits.torque_max,
            *impedance_of(parameters.impedance),
            parameters.observer.gain,
            parameters.observer.ticks,
            tick,
        )
        q = self._plant.state.q
        mass = kinematics.mass_matrix(q)
        zero = np.zeros(len(q))
        self._memory = _Memory(
            q.copy(), q.copy(), zero.copy(), zero.copy(), zero.copy(), mass, zero.copy(), zero
        )
        _adapt(self._settings, self._memory)
        self._plant.torque[:] = kinematics.gravity(q)
        self._ticks = 0
        views = self._plant, self._settings, self._memory
        self._run = compiled(_run, *views, 0, 0, np.empty((0, 3, len(q))))
        self._truth = q, self._plant.state.v, self._plant.torque
        self._measure = compiled(_measure, *self._truth, np.empty((3, len(q))))

    @property
    def residual(self) -> Array:
        """See `control_loop.ControlLoop`; a view that `run` changes."""
        return self._memory.residual

    def head_for(self, q: Array) -> None:
        """See `control_loop.ControlLoop`."""
        self._memory.command[:] = q

    def set_impedance(self, stiffness: Array, damping_ratio: Array) -> None:
        """See `control_loop.ControlLoop`."""
        self._settings.stiffness[:] = stiffness
        self._settings.damping_ratio[:] = damping_ratio

    def run(self, ticks: int, noise: Array) -> int:
        """See `control_loop.ControlLoop`."""
        views = self._plant, self._settings, self._memory
        done: int = self._run(*views, self._ticks, ticks, noise)
        self._ticks += done
        return done

    def measure(self, noise: Array) -> tuple[Array, Array, Array]:
        """See `control_loop.ControlLoop`."""
        self._measure(*self._truth, noise)
        position, velocity, torque = noise
        return position, velocity, torque


@numba.njit(cache=True)
def _run(plant, settings, memory, before, ticks, noise):
    estimates = 0
    for done in range(1, ticks + 1):
        _control(plant, settings, memory)
        mj_step(plant.state.model, plant.state.data)
        for number in plant.warnings:
            if number:
                return done
        if (before + done) % settings.ticks_per_estimate == 0:
            _observe(plant, settings, memory, noise[estimates])
            estimates += 1
        if plant.contacts[0] > 0.0:
            return done
    return ticks


@numba.njit(cache=True)
def _measure(q, v, torque, noise):
    for i in range(q.shape[0]):
        noise[0, i] += q[i]
        noise[1, i] += v[i]
        noise[2, i] += torque[i]


@numba.njit(cache=True)
def _control(plant, settings, memory):
    q, v, torque = plant.state.q, plant.state.v, plant.torque
    position, velocity = memory.position, memory.velocity
    transition = settings.transition
    gravity_at(settings.still, q, torque)
    for i in range(q.shape[0]):
        before, speed, command = position[i], velocity[i], memory.command[i]
        position[i] = (
            transition[0, 0] * before + transition[0, 1] * speed + transition[0, 2] * command
        )
        velocity[i] = (
            transition[1, 0] * before + transition[1, 1] * speed + transition[1, 2] * command
        )
        spring = (position[i] - q[i]) * settings.stiffness[i]
        total = spring + (velocity[i] - v[i]) * memory.damping[i] + torque[i]
        torque[i] = max(min(total, settings.torque_max[i]), -settings.torque_max[i])
        memory.torque_sum[i] += torque[i]


@numba.njit(cache=True)
def _observe(plant, settings, memory, noise):
    residual = memory.residual
    for i in range(residual.shape[0]):
        noise[0, i] += plant.state.q[i]
        noise[1, i] += plant.state.v[i]
        noise[2, i] += memory.torque_sum[i] / settings.ticks_per_estimate
        memory.torque_sum[i] = 0.0
    position, velocity, torque = noise[0], noise[1], noise[2]
    joints = residual.shape[0]
    mass, bias = np.empty((joints, joints)), np.empty(joints)
    mass_and_bias_at(settings.moving, position, velocity, mass, bias)
    elapsed = settings.ticks_per_estimate * settings.tick
    gain = settings.gain
    for i in range(residual.shape[0]):
        inertial = 0.0
        for k in range(residual.shape[0]):
            change = velocity[k] - memory.measured_velocity[k]
            inertial += (mass[i, k] + memory.mass[i, k]) * change
        known = bias[i] + plant.damping[i] * velocity[i] - torque[i]
        external = 0.5 * inertial + known * elapsed
        residual[i] = (residual[i] + gain * external) / (1.0 + gain * elapsed)
    for i in range(residual.shape[0]):
        memory.measured_velocity[i] = velocity[i]
        for k in range(residual.shape[0]):
            memory.mass[i, k] = mass[i, k]
    _adapt(settings, memory)


@numba.njit(cache=True)
def _adapt(settings, memory):
    for i in range(memory.damping.shape[0]):
        spring = settings.stiffness[i] * memory.mass[i, i]
        memory.damping[i] = 2.0 * settings.damping_ratio[i] * np.sqrt(spring)
