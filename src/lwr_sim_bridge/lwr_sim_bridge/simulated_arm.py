# SPDX-License-Identifier: Apache-2.0
"""The simulated arm: takes joint positions, reports what the real arm would report."""

from collections.abc import Mapping
from operator import gt
from types import MappingProxyType

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from lwr_description import Kinematics, Mount
from lwr_guard import CommandGate, CommandWatch, Refusal
from lwr_sim_bridge.command_delay import CommandDelay
from lwr_sim_bridge.contact_truth import ContactForce, ContactTruth
from lwr_sim_bridge.control_loop_kernel import ControlLoop
from lwr_sim_bridge.errors import SimulationError
from lwr_sim_bridge.parameters import ArmParameters
from lwr_sim_bridge.scene_model import SceneModel
from lwr_sim_bridge.sensors import Sensors
from srnn_config.scene import Scene
from srnn_msgs_py.joints import JointSample

TICK = 0.001
"""Period of physics and joint controller [s]."""

_IMPOSSIBLE = 10.0
"""Joints that turn faster than so many times their limit are numbers gone wrong, no arm."""


class SimulatedArm:
    """Plant, joint impedance controller and torque observer, advanced by whole ticks.

    The controller and the observer know the *nominal* arm; the plant is heavier and rubs, as
    `ArmParameters.mismatch` says. Runs with equal arguments, seed and calls are bit-identical.

    Attributes:
        model: the plant's MuJoCo model, for viewers and disturbances.
        data: the plant's MuJoCo state, for viewers and disturbances.
        watch: whether commands still come.

    """

    def __init__(
        self, parameters: ArmParameters, mount: Mount, scene: Scene, rng: np.random.Generator
    ) -> None:
        """Hold still with the tip at `scene.start`, obstacles as in segment 0.

        Raises:
            SceneShapeError: the simulator cannot build an obstacle.
            UnreachableError: the arm cannot reach the start.
            DescriptionError: there is no model of the arm, or it is not of the arm described.
            ParameterError: `parameters` are not those of the arm.

        """
        parameters.fit(mount.description)
        self._kinematics = Kinematics(mount)
        self._scene = SceneModel(mount, parameters, scene.obstacles)
        self.model, self.data = self._scene.model, self._scene.data
        self.model.opt.timestep = TICK
        start = self._kinematics.inverse((*scene.start, 0.0))
        self._scene.place(start)
        self._q, self._v = self.data.qpos, self.data.qvel
        self._warnings = self.data.warning.number
        self._no_warnings = bytes(self._warnings.nbytes)
        self._clock = self.data.time
        limits = self._kinematics.limits
        self._impossible = (_IMPOSSIBLE * limits.velocity_max).tolist()
        self._gate = CommandGate(parameters.guard, limits, start)
        self.watch = CommandWatch(parameters.guard)
        self._delay = CommandDelay(round(parameters.command.delay / TICK))
        self._loop = ControlLoop(parameters, self._kinematics, self._scene, TICK)
        self._ticks_per_estimate = parameters.observer.ticks
        self._sensors = Sensors(scene.noise, parameters.noise, len(start), rng)
        self._truth = ContactTruth(self.model, self.data, self._scene.tool)
        self._ticks = 0
        self.set_segment(0)

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._ticks * TICK

    @property
    def truth(self) -> ContactForce:
        """True contact force; for scoring, never for control."""
        return self._truth.read()

    @property
    def tip_truth(self) -> NDArray[np.float64]:
        """True tip (3,) in `srnn_workspace` [m]; for scoring, never for control."""
        return self._kinematics.tip(self._q)

    @property
    def obstacles_present(self) -> tuple[int, ...]:
        """Indices of the scene's obstacles that stand there now."""
        return self._scene.present()

    @property
    def refused(self) -> Mapping[Refusal, int]:
        """How many commands were refused, by reason."""
        return MappingProxyType(self._gate.refused)

    def set_segment(self, segment: int) -> None:
        """Let the obstacles of segment number `segment` appear and the others vanish.

        An obstacle that would appear inside the tool waits until the tool has left.
        """
        self._scene.set_segment(segment)

    def set_obstacle(self, index: int, there: bool) -> None:
        """Put obstacle number `index` of the scene there, or take it away, from now on."""
        self._scene.set_obstacle(index, there)

    def set_impedance(self, stiffness: ArrayLike, damping_ratio: ArrayLike) -> None:
        """Change the joint impedance law from now on.

        Args:
            stiffness: (n,) of the joints [Nm/rad].
            damping_ratio: (n,) share of critical damping of the joints.

        """
        self._loop.set_impedance(np.array(stiffness), np.array(damping_ratio))

    def clear_peak(self) -> None:
        """Start a new search for `truth.peak`."""
        self._truth.clear_peak()

    def command(self, q: ArrayLike) -> Refusal | None:
        """Head for the joint angles `q` (n,) [rad].

        It gets there `ArmParameters.command.delay` later.

        Returns:
            None when accepted, else why not; the arm then keeps to the last good command.

        """
        refusal = self._gate.offer(q, self.time)
        if refusal is None:
            self.watch.good(self.time)
            self._delay.give(self._gate.last)
        return refusal

    def step(self, ticks: int = 1) -> None:
        """Advance one cycle: joint controller, physics, observer; many ticks at once are cheaper.

        Raises:
            SimulationError: the simulator has warned, its time has leapt, or its joints are
                faster than joints can be.

        """
        end, estimates = self._ticks + ticks, self._ticks // self._ticks_per_estimate
        noise = self._sensors.noise(end // self._ticks_per_estimate - estimates)
        while self._ticks < end:
            arrived = self._delay.due()
            if arrived is not None:
                self._loop.head_for(arrived)
            # The truth of a contact and obstacles that wait are looked at in every tick.
            alone = self._truth.fading or self._scene.waiting
            most = 1 if alone else min(end - self._ticks, 1 + self._delay.quiet)
            done = self._loop.run(
                int(most), noise[self._ticks // self._ticks_per_estimate - estimates:]
            )
            self._delay.skip(done - 1)
            self._ticks += done
            self._check(done)
            self._truth.update()
            self._scene.settle()
        self.watch.cycle(self.time)

    def sample(self, stamp_ns: int) -> JointSample:
        """Return what the arm measures now, noise included, stamped `stamp_ns` [ns].

        The external torque is the arm's own estimate: it knows nothing of the true contacts.
        """
        measured = self._loop.measure(self._sensors.noise(1)[0])
        return JointSample(stamp_ns, *measured, self._loop.residual.copy())

    def _check(self, ticks: int) -> None:
        reason = self._broken(ticks)
        if reason:
            raise SimulationError(
                f'simulated arm at {self.time:.3f} s: {reason}; '
                f'q = {self._q.tolist()}, v = {self._v.tolist()}'
            )

    def _broken(self, ticks: int) -> str:
        """Return why the last ticks were not those of an arm, nothing if they were."""
        # MuJoCo looks for numbers that are not finite, and warns, before each step.
        if self._warnings.tobytes() != self._no_warnings:
            kinds = [kind for kind, number in enumerate(self._warnings) if number]
            return ', '.join(mujoco.mjtWarning(kind).name for kind in kinds)
        passed, self._clock = self.data.time - self._clock, self.data.time
        if abs(passed - ticks * TICK) > 0.5 * TICK:
            return f'its time went by {passed:.3f} s in {ticks} ms'
        if any(map(gt, map(abs, self._v.tolist()), self._impossible)):
            return 'a joint turns faster than it can'
        return ''
