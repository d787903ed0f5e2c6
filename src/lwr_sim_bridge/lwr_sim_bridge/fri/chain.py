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

    def poses_and_jacobians(self, q: ArrayLike) -> tuple[Array, Array]:
        """Return poses and Jacobians of the tool in the base for n postures.

        Args:
            q: (n, 7) joint angles [rad].

        Returns:
            (n, 3, 4) [R | p], p in m, and (n, 6, 7): rows X, Y, Z [m/rad], then RX, RY, RZ.

        """
        angles = np.asarray(q, dtype=float)[:, :, None, None]
        # Rodrigues' formula, for each joint about its own axis.
        turns = np.eye(3) + np.sin(angles) * _CROSS + (1.0 - np.cos(angles)) * _CROSS_TWICE
        count = len(angles)
        rotation, position = np.broadcast_to(np.eye(3), (count, 3, 3)), np.zeros((count, 3))
        places, axes = np.empty((2, count, 7, 3))
        for joint, offset in enumerate(_OFFSETS):
            position = position + offset * rotation[:, :, 2]
            places[:, joint], axes[:, joint] = position, rotation @ _AXES[joint]
            rotation = rotation @ turns[:, joint]
        tool = position + self._tool_length * rotation[:, :, 2]
        poses = np.concatenate((rotation, tool[:, :, None]), axis=2)
        linear = np.cross(axes, tool[:, None] - places)
        return poses, np.concatenate((linear, axes), axis=2).swapaxes(1, 2)
