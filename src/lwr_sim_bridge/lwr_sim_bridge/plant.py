# SPDX-License-Identifier: Apache-2.0
"""What the control loop reads and moves."""

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from lwr_description.handle import Handle


class Plant(NamedTuple):
    """Views into a MuJoCo model and its state; valid only while these live.

    Attributes:
        state: addresses, angles and velocities.
        torque: (n,) joint torques that act in the next tick [Nm].
        damping: (n,) viscous friction of the joints [Nm s/rad].
        warnings: (W,) how often the simulator has warned, by kind.
        contacts: (1,) number of contacts of the tool in the last tick.

    """

    state: Handle
    torque: NDArray[np.float64]
    damping: NDArray[np.float64]
    warnings: NDArray[np.int32]
    contacts: NDArray[np.float64]

    @classmethod
    def of(cls, model: mujoco.MjModel, data: mujoco.MjData) -> 'Plant':
        """Return the plant of a `SceneModel`."""
        state = Handle.of(model, data)
        return cls(state, data.ctrl, model.dof_damping, data.warning.number, data.sensordata)
