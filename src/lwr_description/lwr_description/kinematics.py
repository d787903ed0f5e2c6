# SPDX-License-Identifier: Apache-2.0
"""Kinematics and rigid-body dynamics of the nominal arm, computed by MuJoCo's C functions."""

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from lwr_description.arm_spec import TIP_SITE, WORKSPACE_SITE, arm_spec
from lwr_description.errors import UnreachableError
from lwr_description.handle import Handle
from lwr_description.mount import Mount

Array = NDArray[np.float64]

_INVERSE_ITERATIONS = 100
_INVERSE_DAMPING = 1e-8
_POSITION_TOLERANCE = 1e-7
_POSTURE_TOLERANCE = 1e-7
_STEP_MAX = 0.3


class Kinematics:
    """The mounted arm as a function of its joint angles; holds scratch memory, no state.

    Joint arguments are (n,) arrays [rad], in the order of the description. Positions are those
    of the tip in `srnn_workspace` [m]. Returned arrays belong to the caller.

    Attributes:
        joints: names of the n joints.
        limits: what they may do at most.
        home: (n,) rest posture [rad], read-only.
        still: scratch memory for compiled code, at rest; valid while this object lives.
        moving: the same for code that sets velocities.
        tip_site: number of the tip's site.
        tip_world: (3,) tip of `still` in the world [m]; a view.
        origin: (3,) origin of `srnn_workspace` in the world [m].

    """

    def __init__(self, mount: Mount) -> None:
        """Compile the arm of `mount`, without contacts.

        Raises:
            DescriptionError: there is no model file, or it is not of the arm described.

        """
        spec = arm_spec(mount)
        spec.compiler.discardvisual = True  # Shapes for the eye alone cost time in every call.
        self._model = spec.compile()
        self._model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        self._data = mujoco.MjData(self._model)
        self._moving = mujoco.MjData(self._model)
        self.tip_site: int = self._model.site(TIP_SITE).id
        self.tip_world: Array = self._data.site_xpos[self.tip_site]
        mujoco.mj_kinematics(self._model, self._data)
        self.origin: Array = self._data.site(WORKSPACE_SITE).xpos.copy()
        self.still = Handle.of(self._model, self._data)
        self.moving = Handle.of(self._model, self._moving)
        self.joints = mount.description.joints
        self.limits = mount.description.limits
        self.home = np.array(mount.home)
        self.home.flags.writeable = False

    def tip(self, q: Array) -> Array:
        """Return the tip (3,) in `srnn_workspace` [m]."""
        self._data.qpos = q
        mujoco.mj_kinematics(self._model, self._data)
        return self.tip_world - self.origin

    def jacobian(self, q: Array) -> Array:
        """Return d tip / d q, (3, n) [m/rad]."""
        self._place(q)
        jacobian = np.empty((3, len(q)))
        mujoco.mj_jacSite(self._model, self._data, jacobian, None, self.tip_site)
        return jacobian

    def tip_and_jacobian(self, q: Array) -> tuple[Array, Array]:
        """Return `tip` (3,) and `jacobian` (3, n) for the price of one."""
        jacobian = self.jacobian(q)
        return self.tip_world - self.origin, jacobian

    def tip_force(self, q: Array, torque: Array) -> Array:
        """Return the force (3,) at the tip [N] that best explains joint torques (n,) [Nm]."""
        jacobian = self.jacobian(q)
        return np.asarray(np.linalg.solve(jacobian @ jacobian.T, jacobian @ torque), dtype=float)

    def mass_matrix(self, q: Array) -> Array:
        """Return the joint-space inertia (n, n) [kg m^2], armature included."""
        self._place(q)
        mass = np.empty((len(q), len(q)))
        mujoco.mj_makeM(self._model, self._data)
        mujoco.mj_fullM(self._model, self._data, mass)
        return mass

    def gravity(self, q: Array) -> Array:
        """Return the torques (n,) [Nm] that hold the arm still against gravity."""
        self._place(q)
        torque = np.empty(len(q))
        mujoco.mj_rne(self._model, self._data, 0, torque)
        return torque

    def mass_and_bias(self, q: Array, velocity: Array) -> tuple[Array, Array]:
        """Return `mass_matrix` (n, n) and C(q, v) v + g(q), (n,) [Nm], for the price of one.

        Args:
            q: (n,) joint angles [rad].
            velocity: (n,) joint velocities v [rad/s].

        """
        data = self._moving
        data.qpos = q
        data.qvel = velocity
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_comPos(self._model, data)
        mujoco.mj_comVel(self._model, data)
        mass, bias = np.empty((len(q), len(q))), np.empty(len(q))
        mujoco.mj_makeM(self._model, data)
        mujoco.mj_fullM(self._model, data, mass)
        mujoco.mj_rne(self._model, data, 0, bias)
        return mass, bias

    def inverse(self, target: ArrayLike, seed: Array | None = None) -> Array:
        """Return the joint angles nearest to home whose tip is at `target`.

        Gauss-Newton steps of: minimise |q - home| subject to tip(q) = target, with damped
        pseudo-inverse (Nakamura and Hanafusa 1986) and clipping at the joint limits.

        Args:
            target: (3,) position in `srnn_workspace` [m].
            seed: (n,) where to start searching [rad]; None starts at home.

        Raises:
            UnreachableError: `target` is not finite or out of reach.

        """
        goal = np.asarray(target, dtype=float)
        if goal.shape != (3,) or not np.isfinite(goal).all():
            raise UnreachableError(f'inverse: target = {target!r}: must be three finite numbers')
        q = np.array(self.home if seed is None else seed, dtype=float)
        for _ in range(_INVERSE_ITERATIONS):
            tip, jacobian = self.tip_and_jacobian(q)
            error = goal - tip
            step = self._posture_step(q, error, jacobian)
            new = np.clip(q + step, self.limits.position_min, self.limits.position_max)
            moved = np.abs(new - q).max()
            if np.abs(error).max() < _POSITION_TOLERANCE and moved < _POSTURE_TOLERANCE:
                return q
            q = new
        error = goal - self.tip(q)
        if np.abs(error).max() < _POSITION_TOLERANCE:
            return q
        raise UnreachableError(
            f'inverse: target = {goal.tolist()} m: out of reach, '
            f'the nearest point found is {np.linalg.norm(error):.4f} m away'
        )

    def _place(self, q: Array) -> None:
        self._data.qpos = q
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)

    def _posture_step(self, q: Array, error: Array, jacobian: Array) -> Array:
        gram = jacobian @ jacobian.T
        gram.flat[::4] += _INVERSE_DAMPING
        home = self.home - q
        step = home + jacobian.T @ np.linalg.solve(gram, error - jacobian @ home)
        limited: Array = step * min(1.0, _STEP_MAX / (np.abs(step).max() + 1e-12))
        return limited
