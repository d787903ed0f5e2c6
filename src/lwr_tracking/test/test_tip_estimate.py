# SPDX-License-Identifier: Apache-2.0
"""The tip and its force come from angles and torques."""

import numpy as np
import pytest

from lwr_description import Kinematics, Mount
from lwr_tracking.core.tip_estimate import TipEstimate

KINEMATICS = Kinematics(Mount())
FORCE = np.array([12.0, -7.0, 3.0])


@pytest.mark.parametrize('place', [(0.0, 0.0), (0.28, 0.2), (-0.25, -0.28)])
def test_the_force_is_recovered_from_the_torques_it_causes(place):
    q = KINEMATICS.inverse((*place, 0.0))
    torque = KINEMATICS.jacobian(q).T @ FORCE
    tip, force = TipEstimate(KINEMATICS).measure(q, torque)
    np.testing.assert_allclose(tip[:2], place, atol=1e-6)
    np.testing.assert_allclose(force, FORCE, atol=1e-9)
