# SPDX-License-Identifier: Apache-2.0
"""Kinematics obeys its definitions: derivatives, inverses, energy."""

from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_description import POSITION_MAX, Kinematics, Mount, UnreachableError

KINEMATICS = Kinematics(Mount())
EDGE = 0.30
coordinate = st.floats(-EDGE, EDGE)


def random_poses(count, seed=3):
    return np.random.default_rng(seed).uniform(-POSITION_MAX, POSITION_MAX, (count, 7))


def finite_difference(function, q, step=1e-6):
    columns = [(function(q + d) - function(q - d)) / (2 * step) for d in step * np.eye(7)]
    return np.stack(columns, axis=-1)


def test_home_is_at_the_middle_of_the_workspace():
    np.testing.assert_allclose(KINEMATICS.tip(KINEMATICS.home), [0.0005, 0, 0.001], atol=1e-4)


def test_jacobian_is_the_derivative_of_the_tip():
    for q in random_poses(10):
        np.testing.assert_allclose(
            KINEMATICS.jacobian(q), finite_difference(KINEMATICS.tip, q), atol=1e-8
        )


def test_tip_and_jacobian_are_the_two():
    for q in random_poses(3):
        tip, jacobian = KINEMATICS.tip_and_jacobian(q)
        np.testing.assert_array_equal(tip, KINEMATICS.tip(q))
        np.testing.assert_array_equal(jacobian, KINEMATICS.jacobian(q))


def test_results_are_not_overwritten_by_the_next_call():
    first, second = random_poses(2)
    tip, jacobian = KINEMATICS.tip_and_jacobian(first)
    kept = tip.copy(), jacobian.copy()
    KINEMATICS.tip_and_jacobian(second)
    np.testing.assert_array_equal(tip, kept[0])
    np.testing.assert_array_equal(jacobian, kept[1])


@settings(deadline=None, max_examples=60)
@given(coordinate, coordinate)
def test_tip_of_the_inverse_is_the_target_everywhere_on_the_plane(x, y):
    q = KINEMATICS.inverse([x, y, 0.0])
    np.testing.assert_allclose(KINEMATICS.tip(q), [x, y, 0.0], atol=1e-6)
    assert (np.abs(q) < POSITION_MAX - np.radians(23)).all()


@settings(deadline=None, max_examples=30)
@given(coordinate, coordinate, coordinate, coordinate)
def test_inverse_does_not_depend_on_its_seed(x, y, seed_x, seed_y):
    seed = KINEMATICS.inverse([seed_x, seed_y, 0.0])
    q = KINEMATICS.inverse([x, y, 0.0])
    np.testing.assert_allclose(KINEMATICS.inverse([x, y, 0.0], seed), q, atol=1e-5)


def test_inverse_of_the_home_tip_is_home():
    q = KINEMATICS.inverse(KINEMATICS.tip(KINEMATICS.home))
    np.testing.assert_allclose(q, KINEMATICS.home, atol=1e-6)


@pytest.mark.parametrize('target', [[2.0, 0.0, 0.0], [np.nan, 0.0, 0.0], [0.0, 0.0]])
def test_inverse_refuses_what_it_cannot_reach(target):
    with pytest.raises(UnreachableError, match='target'):
        KINEMATICS.inverse(target)


def test_mass_matrix_is_symmetric_and_positive():
    for q in random_poses(10):
        mass = KINEMATICS.mass_matrix(q)
        np.testing.assert_allclose(mass, mass.T, atol=1e-12)
        assert np.linalg.eigvalsh(mass).min() > 0.0


def test_bias_at_rest_is_gravity():
    for q in random_poses(5):
        mass, bias = KINEMATICS.mass_and_bias(q, np.zeros(7))
        np.testing.assert_allclose(bias, KINEMATICS.gravity(q))
        np.testing.assert_array_equal(mass, KINEMATICS.mass_matrix(q))


def test_coriolis_torques_turn_no_power_into_energy():
    """v.(C v) = v.(Mdot v) / 2: the kinetic energy changes by M's motion alone."""
    rng = np.random.default_rng(8)
    for q in random_poses(5):
        v = rng.normal(size=7)
        coriolis = KINEMATICS.mass_and_bias(q, v)[1] - KINEMATICS.gravity(q)
        rate = finite_difference(KINEMATICS.mass_matrix, q) @ v
        assert v @ coriolis == pytest.approx(v @ rate @ v / 2, abs=1e-6)
