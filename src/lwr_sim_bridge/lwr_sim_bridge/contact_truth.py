# SPDX-License-Identifier: Apache-2.0
"""The force that the obstacles really exert on the tool: for scoring, never for control."""

from dataclasses import dataclass
from math import exp, pi

import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CUT_OFF = 100.0
"""Corner of the low-pass behind `ContactForce.low_pass` [Hz]; the raw peak of an impact is an
artefact of the time step."""


@dataclass(frozen=True, eq=False)
class ContactForce:
    """Force of the obstacles on the tool, axes of `srnn_workspace`.

    Attributes:
        raw: (3,) force in the last tick [N].
        low_pass: (3,) the same through a 100 Hz first-order low-pass [N].
        peak: largest magnitude of `low_pass` since the peak was last cleared [N].

    """

    raw: Array
    low_pass: Array
    peak: float


class ContactTruth:
    """Sums the simulator's contact forces, tick by tick.

    Attributes:
        fading: there was a force; `update` must not miss a tick until it has faded.

    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, tool: int) -> None:
        """Watch the contacts of geometry number `tool`."""
        self._model = model
        self._data = data
        self._tool = tool
        self._share = 1.0 - exp(-2.0 * pi * CUT_OFF * model.opt.timestep)
        self._wrench = np.empty(6)
        self._raw = np.zeros(3)
        self._low_pass = np.zeros(3)
        self.fading = False
        self._peak = 0.0

    def update(self) -> None:
        """Take in the tick that has just been simulated; without contact it may be left out."""
        touching = self._data.ncon > 0
        if not (touching or self.fading):
            return
        self._raw = self._sum() if touching else np.zeros(3)
        self._low_pass = self._low_pass + self._share * (self._raw - self._low_pass)
        magnitude = float(np.linalg.norm(self._low_pass))
        self._peak = max(self._peak, magnitude)
        self.fading = touching or magnitude > 1e-6

    def read(self) -> ContactForce:
        """Return the force of the last tick."""
        return ContactForce(self._raw.copy(), self._low_pass.copy(), self._peak)

    def clear_peak(self) -> None:
        """Start a new search for the peak."""
        self._peak = 0.0

    def _sum(self) -> Array:
        total = np.zeros(3)
        contacts = self._data.contact
        for i in range(self._data.ncon):
            mujoco.mj_contactForce(self._model, self._data, i, self._wrench)
            force = self._wrench[:3] @ contacts.frame[i].reshape(3, 3)
            # MuJoCo's normal points from the first geometry to the second.
            total += force if contacts.geom[i, 1] == self._tool else -force
        return total
