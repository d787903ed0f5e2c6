# SPDX-License-Identifier: Apache-2.0
"""The joint impedance law is what its formula says, inside the torque limits."""

import numpy as np
import pytest

from lwr_description import TORQUE_MAX
from lwr_sim_bridge import ImpedanceParameters
from lwr_sim_bridge.impedance import JointImpedance, impedance_of

PARAMETERS = ImpedanceParameters()
STIFFNESS = np.array(PARAMETERS.stiffness)
MASS = np.diag([2.0, 2.0, 0.5, 0.5, 0.1, 0.05, 0.03])
ZERO = np.zeros(7)


@pytest.fixture
def law():
    law = JointImpedance(*impedance_of(PARAMETERS), TORQUE_MAX)
    law.adapt(MASS)
    return law


def test_without_error_it_carries_gravity_alone(law):
    q, v, gravity = np.linspace(-1, 1, 7), np.linspace(0, 0.3, 7), np.linspace(5, -5, 7)
    np.testing.assert_allclose(law.torque(q, v, q, v, gravity), gravity)


def test_position_error_meets_the_stiffness(law):
    error = np.full(7, 1e-3)
    np.testing.assert_allclose(law.torque(ZERO, ZERO, error, ZERO, ZERO), STIFFNESS * error)


def test_velocity_error_meets_the_stated_damping_ratio(law):
    error = np.full(7, 1e-2)
    damping = law.torque(ZERO, ZERO, ZERO, error, ZERO) / error
    ratio = damping / (2 * np.sqrt(STIFFNESS * MASS.diagonal()))
    np.testing.assert_allclose(ratio, PARAMETERS.damping_ratio)


def test_a_softer_law_is_softer_in_the_joint_that_was_made_so(law):
    stiffness, ratio = np.where(np.arange(7) == 3, 50.0, STIFFNESS), np.full(7, 0.5)
    law.set(stiffness, ratio)
    law.adapt(MASS)
    error = np.full(7, 1e-3)
    np.testing.assert_allclose(law.torque(ZERO, ZERO, error, ZERO, ZERO), stiffness * error)
    damping = law.torque(ZERO, ZERO, ZERO, error, ZERO) / error
    np.testing.assert_allclose(damping, 2 * ratio * np.sqrt(stiffness * MASS.diagonal()))


def test_torque_is_clamped_on_both_sides(law):
    far = np.full(7, 10.0)
    np.testing.assert_array_equal(law.torque(ZERO, ZERO, far, ZERO, ZERO), TORQUE_MAX)
    np.testing.assert_array_equal(law.torque(ZERO, ZERO, -far, ZERO, ZERO), -TORQUE_MAX)


def test_stiffness_beyond_the_real_arm_is_refused():
    with pytest.raises(ValueError, match='stiffness'):
        ImpedanceParameters(stiffness=(5000.0,) * 7)
