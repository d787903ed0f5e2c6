# SPDX-License-Identifier: Apache-2.0
"""Compiled code gets bit for bit what `Kinematics` returns."""

import numpy as np

from lwr_description import POSITION_MAX, Kinematics, Mount
from lwr_description.kinematics_kernel import gravity_at, jacobian_at, mass_and_bias_at

KINEMATICS = Kinematics(Mount())
EQUAL = Kinematics(Mount())
RNG = np.random.default_rng(5)
POSES = RNG.uniform(-POSITION_MAX, POSITION_MAX, (10, 7))
VELOCITIES = RNG.uniform(-1.0, 1.0, (10, 7))


def test_the_jacobian_and_the_tip():
    jacobian = np.empty((3, 7))
    for q in POSES:
        jacobian_at(KINEMATICS.still, KINEMATICS.tip_site, q, jacobian)
        tip = KINEMATICS.tip_world - KINEMATICS.origin
        expected_tip, expected = EQUAL.tip_and_jacobian(q)
        np.testing.assert_array_equal(jacobian, expected)
        np.testing.assert_array_equal(tip, expected_tip)


def test_gravity_also_after_motion():
    torque = np.empty(7)
    for q, v in zip(POSES, VELOCITIES, strict=True):
        mass_and_bias_at(KINEMATICS.moving, q, v, np.empty((7, 7)), np.empty(7))
        gravity_at(KINEMATICS.still, q, torque)
        np.testing.assert_array_equal(torque, EQUAL.gravity(q))


def test_mass_and_bias():
    mass, bias = np.empty((7, 7)), np.empty(7)
    for q, v in zip(POSES, VELOCITIES, strict=True):
        mass_and_bias_at(KINEMATICS.moving, q, v, mass, bias)
        expected_mass, expected_bias = EQUAL.mass_and_bias(q, v)
        np.testing.assert_array_equal(mass, expected_mass)
        np.testing.assert_array_equal(bias, expected_bias)
