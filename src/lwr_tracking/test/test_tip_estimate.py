# SPDX-License-Identifier: Apache-2.0
"""The tip and its force come from angles and torques, compiled or not."""

import numpy as np
import pytest

from lwr_description import POSITION_MAX, Kinematics, Mount
from lwr_tracking.core import tip_estimate, tip_estimate_kernel

KINEMATICS = Kinematics(Mount())
FORCE = np.array([12.0, -7.0, 3.0])


@pytest.mark.parametrize('module', [tip_estimate, tip_estimate_kernel])
@pytest.mark.parametrize('place', [(0.0, 0.0), (0.28, 0.2), (-0.25, -0.28)])
def test_the_force_is_recovered_from_the_torques_it_causes(module, place):
    q = KINEMATICS.inverse((*place, 0.0))
    torque = KINEMATICS.jacobian(q).T @ FORCE
    tip, force = module.TipEstimate(KINEMATICS).measure(q, torque)
    np.testing.assert_allclose(tip[:2], place, atol=1e-6)
    np.testing.assert_allclose(force, FORCE, atol=1e-9)


def test_compiled_is_plain():
    rng = np.random.default_rng(6)
    compiled, plain = (m.TipEstimate(KINEMATICS) for m in (tip_estimate_kernel, tip_estimate))
    for _ in range(50):
        q, torque = 0.7 * POSITION_MAX * rng.uniform(-1, 1, 7), rng.normal(0.0, 5.0, 7)
        tip, force = compiled.measure(q, torque)
        plain_tip, plain_force = plain.measure(q, torque)
        np.testing.assert_array_equal(tip, plain_tip)
        np.testing.assert_allclose(force, plain_force, rtol=1e-6, atol=1e-6)


def test_measurements_may_be_read_only_or_lie_apart_in_memory():
    q, torque = np.repeat(KINEMATICS.home, 2)[::2], np.linspace(0.0, 3.0, 7)
    torque.flags.writeable = False
    tip, force = tip_estimate_kernel.TipEstimate(KINEMATICS).measure(q, torque)
    plain_tip, plain_force = tip_estimate.TipEstimate(KINEMATICS).measure(q, torque)
    np.testing.assert_array_equal(tip, plain_tip)
    np.testing.assert_allclose(force, plain_force, rtol=1e-9)
