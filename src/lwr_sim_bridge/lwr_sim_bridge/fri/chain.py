# SPDX-License-Identifier: Apache-2.0
"""Pose and Jacobian of the tool as the controller computes them, from its own chain."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_OFFSETS = (0.110, 0.2005, 0.200, 0.200, 0.200, 0.190, 0.078)
"""From the base to the first joint, and from each joint to the next, along z [m]."""

_AXES = np.array(
    [[0, 0, 1], [0, -1, 0], [0, 0, 1], [0, 1, 0], [0, 0, 1], [0, -1, 0], [0, 0, 1]], dtype=float
)

_CROSS = np.array([np.cross(axis, np.eye(3)).T for axis in _AXES])
"""(7, 3, 3): `_CROSS[i] @ v` is axis i x v."""

_CROSS_TWICE = _CROSS @ _CROSS


class Chain:
    """The LWR 4+ seen from its base; all frames are parallel to the base at q = 0."""

    def __init__(self, tool_length: float) -> None:
        """Take the distance from the flange to the tool centre point [m]."""
        self._tool_length = tool_length

    def pose(self, q: ArrayLike) -> Array:
        """Return [R | p] of the tool in the base, (3, 4), p in m, for angles (7,) [rad]."""
        return self.pose_and_jacobian(q)[0]

    def pose_and_jacobian(self, q: ArrayLike) -> tuple[Array, Array]:
        """Return `pose` and (6, 7): rows X, Y, Z [m/rad], then RX, RY, RZ, in the base."""
        angles = np.asarray(q, dtype=float)[:, None, None]
        # Rodrigues' formula, for each joint about its own axis.
        turns = np.eye(3) + np.sin(angles) * _CROSS + (1.0 - np.cos(angles)) * _CROSS_TWICE
        rotation, position = np.eye(3), np.zeros(3)
        places, axes = np.empty((2, 7, 3))
        for joint, offset in enumerate(_OFFSETS):
            position = position + offset * rotation[:, 2]
            places[joint], axes[joint] = position, rotation @ _AXES[joint]
            rotation = rotation @ turns[joint]
        tool = position + self._tool_length * rotation[:, 2]
        pose = np.column_stack((rotation, tool))
        return pose, np.vstack((np.cross(axes, tool - places).T, axes.T))
