# SPDX-License-Identifier: Apache-2.0
"""The methods of `Kinematics` that are needed in every tick, for compiled code to call.

They take the scratch memory `Kinematics.still` or `Kinematics.moving` and write their results
into arrays of the caller. Numba's cache of a caller does not notice a change in this file:
`make clean` after one.
"""

import numba

from lwr_description.mujoco_c import (
    mj_comPos,
    mj_comVel,
    mj_fullM,
    mj_jacSite,
    mj_kinematics,
    mj_makeM,
    mj_rne,
)


@numba.njit(cache=True)
def jacobian_at(still, tip_site, q, jacobian):
    """Write `Kinematics.jacobian` (3, n); afterwards `Kinematics.tip_world` is the tip."""
    _place(still, q)
    mj_jacSite(still.model, still.data, jacobian.ctypes.data, 0, tip_site)


@numba.njit(cache=True)
def gravity_at(still, q, torque):
    """Write `Kinematics.gravity` (n,)."""
    _place(still, q)
    mj_rne(still.model, still.data, 0, torque.ctypes.data)


@numba.njit(cache=True)
def mass_and_bias_at(moving, q, velocity, mass, bias):
    """Write `Kinematics.mass_and_bias`, (n, n) and (n,)."""
    for i in range(velocity.shape[0]):
        moving.v[i] = velocity[i]
    _place(moving, q)
    mj_comVel(moving.model, moving.data)
    mj_makeM(moving.model, moving.data)
    mj_fullM(moving.model, moving.data, mass.ctypes.data)
    mj_rne(moving.model, moving.data, 0, bias.ctypes.data)


@numba.njit(cache=True)
def _place(handle, q):
    # Loops, here and elsewhere, because numba compiles them faster than array expressions.
    for i in range(q.shape[0]):
        handle.q[i] = q[i]
    mj_kinematics(handle.model, handle.data)
    mj_comPos(handle.model, handle.data)
