# SPDX-License-Identifier: Apache-2.0
"""Contact from the estimated external torques and from the tracking error."""

from enum import Enum
from math import hypot

from lwr_tracking.core.parameters import ContactParameters


class Touch(Enum):
    """What the last sample said, and which rule said it."""

    NONE = ''
    FORCE = 'contact force'
    ERROR = 'tracking error'


class ContactObserver:
    """Two rules, force and error, each confirmed by several samples in a row.

    After a touch the force rule is silent until the force has fallen, so that what is
    left of one contact is not taken for the next. The error rule is always armed.

    Attributes:
        force: planar tip force of the last sample [N].
        error: planar tracking error of the last sample [m].
        armed: the force rule is armed.

    """

    def __init__(self, parameters: ContactParameters) -> None:
        """Start armed."""
        self.force = 0.0
        self.error = 0.0
        self.armed = True
        self._parameters = parameters
        self._force_hits = 0
        self._error_hits = 0
        self._quiet = 0

    @property
    def loaded(self) -> bool:
        """Tell whether the tip may be pressing on something."""
        return not self.armed or self.force > self._parameters.rearm_force

    def update(self, fx: float, fy: float, ex: float, ey: float) -> Touch:
        """Judge one sample.

        Args:
            fx: estimated tip force along x [N].
            fy: the same along y [N].
            ex: where the tip should be minus where it is, along x [m].
            ey: the same along y [m].

        """
        limits = self._parameters
        self.force, self.error = hypot(fx, fy), hypot(ex, ey)
        self._rearm()
        hit = self.armed and self.force > limits.force
        self._force_hits = self._force_hits + 1 if hit else 0
        self._error_hits = self._error_hits + 1 if self.error > limits.error else 0
        if self._force_hits >= limits.samples:
            return Touch.FORCE
        if self._error_hits >= limits.samples:
            return Touch.ERROR
        return Touch.NONE

    def disarm(self) -> None:
        """Acknowledge a touch: silence the force rule until the force has fallen."""
        self.armed = False
        self._force_hits = self._error_hits = self._quiet = 0

    def _rearm(self) -> None:
        self._quiet = self._quiet + 1 if self.force < self._parameters.rearm_force else 0
        if self._quiet >= self._parameters.samples:
            self.armed = True
