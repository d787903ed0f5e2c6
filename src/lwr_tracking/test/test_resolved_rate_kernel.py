# SPDX-License-Identifier: Apache-2.0
"""The compiled inverse kinematics is the plain one."""

import numpy as np
import pytest

from lwr_description import POSITION_MAX, VELOCITY_MAX, Kinematics, Mount
from lwr_tracking.core import resolved_rate, resolved_rate_kernel

DT = 0.004
KINEMATICS = Kinematics(Mount())
BOUNDS = resolved_rate.Bounds(
    lowest=0.05 - POSITION_MAX, highest=POSITION_MAX - 0.05, slow_lowest=0.3 - POSITION_MAX,
    slow_highest=POSITION_MAX - 0.3, velocity=0.9 * VELOCITY_MAX,
    tip_speed=0.4, damping=1e-4, singular=0.1, slow_singular=0.3,
)


@pytest.mark.parametrize('distance', [1e-4, 1e-2, 3.0])
@pytest.mark.parametrize('reach', [0.5, 1.0])
def test_compiled_is_plain_near_and_far_within_the_limits_and_beyond(distance, reach):
    rng = np.random.default_rng(7)
    kernel = resolved_rate_kernel.ResolvedRate(KINEMATICS, BOUNDS)
    reference = resolved_rate.ResolvedRate(KINEMATICS, BOUNDS)
    seen = []
    for draw in np.linspace(0.0, 0.1, 100):
        command = reach * POSITION_MAX * rng.uniform(-1.0, 1.0, 7)
        target = KINEMATICS.tip(command) + distance * rng.uniform(-1.0, 1.0, 3)
        arguments = command, target, DT, float(draw)
        compiled, plain = kernel.step(*arguments), reference.step(*arguments)
        np.testing.assert_allclose(compiled.command, plain.command, rtol=0.0, atol=1e-10)
        np.testing.assert_allclose(compiled[1:], plain[1:], rtol=0.0, atol=1e-7)
        seen.append(compiled)
    assert any(np.abs(step.command - command).max() > 0.0 for step in seen)
    assert (min(step.outward for step in seen) < 1.0) == (reach == 1.0)
    assert min(step.dexterity for step in seen) < 1.0
    if distance == 3.0:
        assert any(step.saturated for step in seen)
