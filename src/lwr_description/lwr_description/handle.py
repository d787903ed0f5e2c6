# SPDX-License-Identifier: Apache-2.0
"""A MuJoCo model and its state, as compiled code sees them."""

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray


class Handle(NamedTuple):
    """Addresses and views; valid only while the model and the state live.

    Attributes:
        model: address of the C structure `mjModel`.
        data: address of its `mjData`.
        q: (n,) joint angles of the state [rad]; a view.
        v: (n,) joint velocities of the state [rad/s]; a view.

    """

    model: int
    data: int
    q: NDArray[np.float64]
    v: NDArray[np.float64]

    @classmethod
    def of(cls, model: mujoco.MjModel, data: mujoco.MjData) -> 'Handle':
        """Return the handle of a model and its state."""
        return cls(model._address, data._address, data.qpos, data.qvel)
