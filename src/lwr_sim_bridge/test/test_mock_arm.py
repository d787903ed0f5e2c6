# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from lwr_description import Kinematics, Mount
from lwr_guard import GuardParameters, Refusal
from lwr_sim_bridge.mock_arm import MockArm

START = (0.1, -0.05)


@pytest.fixture
def arm():
    return MockArm(GuardParameters(), Mount(), START)


def test_it_begins_above_the_start_at_rest(arm):
    sample = arm.sample(7)
    assert sample.stamp_ns == 7
    kinematics = Kinematics(Mount())
    assert np.allclose(kinematics.tip(sample.position), (*START, 0.0), atol=1e-6)
    assert not sample.velocity.any()
    assert not sample.external_torque.any()
    assert (sample.torque == kinematics.gravity(sample.position)).all()


def test_it_is_where_it_was_told_to_be_one_cycle_later(arm):
    q = arm.sample(0).position
    for _ in range(50):
        q = q + 0.004 * np.arange(7) * 0.1
        assert arm.command(q) is None
        arm.step(4)
        sample = arm.sample(0)
        assert (sample.position == q).all()
        assert np.allclose(sample.velocity, 0.1 * np.arange(7))
    arm.step(4)
    assert (arm.sample(0).position == q).all()
    assert not arm.sample(0).velocity.any()


def test_it_refuses_what_no_arm_could_do_and_says_when_commands_cease(arm):
    q = arm.sample(0).position
    assert arm.command(q + 0.05) is Refusal.TOO_FAR
    assert arm.command([np.nan] * 7) is Refusal.NOT_FINITE
    assert arm.command(q) is None
    for _ in range(4):
        arm.step(4)
    assert not arm.watch.holding
    arm.step(4)
    assert arm.watch.holding
    assert arm.refused == {**dict.fromkeys(Refusal, 0), Refusal.TOO_FAR: 1, Refusal.NOT_FINITE: 1}
    assert (arm.sample(0).position == q).all()
