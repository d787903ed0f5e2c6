# SPDX-License-Identifier: Apache-2.0
"""The compiled inverse kinematics is the plain one."""

import numpy as np
import pytest

from lwr_description import POSITION_MAX, VELOCITY_MAX, Kinematics, Mount
from lwr_tracking.core import resolved_rate, resolved_rate_kernel

DT = 0.004
KINEMATICS = Kinematics(Mount())
BOUNDS = resolved_rate.Bounds(POSITION_MAX - 0.05, 0.9 * VELOCITY_MAX, 0.4, 1e-4)


@pytest.mark.parametrize('distance', [1e-4, 1e-2, 3.0])
@pytest.mark.parametrize('reach', [0.5, 1.0])
def test_compiled_is_plain_near_and_far_within_the_limits_and_beyond(distance, reach):
    rng = np.random.default_rng(7)
    kernel = resolved_rate_kernel.ResolvedRate(KINEMATICS, BOUNDS)
    reference = resolved_rate.ResolvedRate(KINEMATICS, BOUNDS)
    for draw in np.linspace(0.0, 0.1, 30):
        command = reach * POSITION_MAX * rng.uniform(-1.0, 1.0, 7)
        target = KINEMATICS.tip(command) + distance * rng.uniform(-1.0, 1.0, 3)
        arguments = command, target, DT, float(draw)
        compiled, plain = kernel.step(*arguments), reference.step(*arguments)
        np.testing.assert_allclose(compiled, plain, rtol=0.0, atol=1e-10)
        assert np.abs(compiled - command).max() > 0.0
