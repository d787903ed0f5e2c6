# SPDX-License-Identifier: Apache-2.0
"""The observer is a first-order low-pass of the external torque and of nothing else."""

import numpy as np
import pytest

from lwr_sim_bridge.momentum_observer import MomentumObserver

GAIN = 50.0
STEP = 0.002


def one_joint(mass, velocity):
    return MomentumObserver(GAIN, np.array([[mass]]), np.array([velocity]))


def test_step_of_external_torque_is_low_passed_with_time_constant_one_over_gain():
    """A free mass pushed by a constant torque: v = t torque / m."""
    mass, external = 2.0, 3.0
    observer = one_joint(mass, 0.0)
    for k in range(1, 61):
        velocity = np.array([external / mass * k * STEP])
        observer.update(np.array([[mass]]), velocity, np.zeros(1), np.zeros(1), STEP)
        expected = external * (1 - np.exp(-GAIN * k * STEP))
        assert observer.residual[0] == pytest.approx(expected, abs=0.04 * external)
    assert observer.residual[0] == pytest.approx(external, rel=0.01)


def test_motor_torque_and_bias_cancel_out():
    """Acceleration by the motor against a bias, no external torque: r stays zero."""
    mass, torque, bias = 0.5, 4.0, 1.5
    observer = one_joint(mass, 0.0)
    for k in range(1, 50):
        velocity = np.array([(torque - bias) / mass * k * STEP])
        observer.update(
            np.array([[mass]]), velocity, np.array([bias]), np.array([torque]), STEP
        )
    np.testing.assert_allclose(observer.residual, 0.0, atol=1e-12)


def test_changing_inertia_is_no_external_torque():
    """With M(q) = 1 + q^2, free motion obeys M v' + q v^2 = 0; the bias is q v^2."""
    q, v, fine = 0.2, 1.5, STEP / 400
    observer = one_joint(1 + q * q, v)
    for _ in range(100):
        bias = []
        for _ in range(400):
            bias.append(q * v * v)
            v -= fine * q * v * v / (1 + q * q)
            q += fine * v
        mass = np.array([[1 + q * q]])
        observer.update(mass, np.array([v]), np.array([np.mean(bias)]), np.zeros(1), STEP)
    assert abs(observer.residual[0]) < 1e-3


def test_it_is_stable_for_any_gain():
    observer = MomentumObserver(1e5, np.eye(1), np.zeros(1))
    for k in range(1, 20):
        observer.update(np.eye(1), np.array([k * STEP]), np.zeros(1), np.zeros(1), STEP)
    assert observer.residual[0] == pytest.approx(1.0, rel=0.01)
