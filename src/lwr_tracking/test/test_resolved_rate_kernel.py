# SPDX-License-Identifier: Apache-2.0
"""The compiled inverse kinematics is the plain one."""

import numpy as np
import pytest

from lwr_description import POSITION_MAX, VELOCITY_MAX, Kinematics, Mount
from lwr_tracking.core import resolved_rate, resolved_rate_kernel

DT = 0.004
KINEMATICS = Kinematics(Mount())
EVEN = resolved_rate.Bounds(
    lowest=0.05 - POSITION_MAX, highest=POSITION_MAX - 0.05, slow_lowest=0.3 - POSITION_MAX,
    slow_highest=POSITION_MAX - 0.3, velocity=0.9 * VELOCITY_MAX,
    tip_speed=0.4, damping=1e-4, singular=0.1, slow_singular=0.3,
)


UNEVEN = EVEN._replace(lowest=0.55 - POSITION_MAX, slow_lowest=0.8 - POSITION_MAX)


@pytest.mark.parametrize('bounds', [EVEN, UNEVEN], ids=['even', 'uneven'])
@pytest.mark.parametrize('distance', [1e-4, 1e-2, 3.0])
@pytest.mark.parametrize('reach', [0.5, 1.0])
def test_compiled_is_plain_near_and_far_within_the_limits_and_beyond(distance, reach, bounds):
    rng = np.random.default_rng(7)
    kernel = resolved_rate_kernel.ResolvedRate(KINEMATICS, bounds)
    reference = resolved_rate.ResolvedRate(KINEMATICS, bounds)
    seen = []
    for draw in np.linspace(0.0, 0.1, 100):
        command = reach * POSITION_MAX * rng.uniform(-1.0, 1.0, 7)
        target = KINEMATICS.tip(command) + distance * rng.uniform(-1.0, 1.0, 3)
        arguments = command, tuple(target.tolist()), DT, float(draw)
        compiled, plain = kernel.step(*arguments), reference.step(*arguments)
        np.testing.assert_allclose(compiled.command, plain.command, rtol=0.0, atol=1e-10)
        np.testing.assert_allclose(compiled[1:], plain[1:], rtol=0.0, atol=1e-7)
        seen.append(compiled)
    assert any(np.abs(step.command - command).max() > 0.0 for step in seen)
    assert (min(step.outward for step in seen) < 1.0) == (reach == 1.0)
    assert min(step.dexterity for step in seen) < 1.0
    if distance == 3.0:
        assert any(step.saturated for step in seen)


@pytest.mark.parametrize('module', [resolved_rate, resolved_rate_kernel])
def test_limits_that_are_not_even_about_zero_are_kept_to_on_both_sides(module):
    """Pulled far away in every direction, no joint leaves its own range."""
    range_of = {'lowest': np.full(7, 0.2), 'highest': np.full(7, 0.9)}
    bounds = EVEN._replace(**range_of, slow_lowest=np.full(7, 0.3), slow_highest=np.full(7, 0.8))
    law = module.ResolvedRate(KINEMATICS, bounds)
    rng, slowest = np.random.default_rng(3), 1.0
    for _ in range(10):
        command = rng.uniform(0.25, 0.85, 7)
        target = tuple((KINEMATICS.tip(command) + rng.normal(size=3)).tolist())
        for _ in range(300):
            step = law.step(command, target, DT, 0.0)
            command, slowest = step.command, min(slowest, step.outward)
            assert (bounds.lowest <= command).all()
            assert (command <= bounds.highest).all()
    assert slowest < 0.1
