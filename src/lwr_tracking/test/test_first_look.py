# SPDX-License-Identifier: Apache-2.0
"""What is in order at first sight is in order, and what it tells is what plain NumPy tells."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_description import TORQUE_MAX, Kinematics, Mount
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.first_look import FirstLook, Ordinary
from lwr_tracking.core.joint_watch import JointWatch
from lwr_tracking.core.parameters import WatchParameters
from lwr_tracking.core.tip_estimate import TipEstimate
from srnn_msgs_py.joints import JointSample

KINEMATICS = Kinematics(Mount())
HOME, LIMITS = KINEMATICS.home, KINEMATICS.limits
DIVERGENCE = 0.15
STEP_NS = 4_000_000
FIELDS = ('position', 'external_torque', 'torque')


def watch():
    return JointWatch(WatchParameters(), LIMITS, 1e-9 * STEP_NS)


LOOK = FirstLook(
    KINEMATICS,
    Ordinary(watch().lowest, watch().highest, TORQUE_MAX, watch().surely, DIVERGENCE),
)


def sample(position=HOME, **changes):
    zero = np.zeros(7)
    return replace(JointSample(STEP_NS, np.array(position), zero, zero, zero), **changes)


def moved(joint, by):
    position = HOME.copy()
    position[joint] += by
    return position


@given(
    st.integers(0, 6), st.floats(-0.2, 0.2) | st.sampled_from([0.0, np.nan, np.inf, -4.0, 4.0]),
    st.floats(-0.2, 0.2), st.sampled_from([0.0, 3.0, np.nan, -np.inf]),
)  # fmt: skip
def test_what_is_in_order_at_first_sight_is_so_for_the_thorough(joint, by, told, external):
    thorough = watch()
    assert thorough.judge(sample(), HOME) is Condition.NONE
    position, command = moved(joint, by), moved(joint, told)
    one = sample(position, stamp_ns=2 * STEP_NS, external_torque=np.full(7, external))
    fine, *_ = LOOK.at(one, HOME, command)
    found = thorough.judge(one, command)
    assert not fine or found is Condition.NONE
    way, lag = np.abs(position - HOME).max(), np.abs(command - position).max()
    assert fine == (0.0 < way <= watch().surely and lag <= DIVERGENCE and np.isfinite(external))


@pytest.mark.parametrize('joint', range(7))
def test_each_joint_is_looked_at(joint):
    near = moved(joint, 1e-3)
    assert LOOK.at(sample(near), HOME, HOME)[0]
    assert not LOOK.at(sample(near), HOME + np.nan, HOME)[0]
    assert not LOOK.at(sample(near), near, HOME)[0]
    assert not LOOK.at(sample(near), HOME, moved(joint, 0.2))[0]
    for limit, sign in ((LIMITS.position_min, -1.0), (LIMITS.position_max, 1.0)):
        position = HOME.copy()
        position[joint] = limit[joint] + sign * 0.021
        before = position - 1e-3
        assert not LOOK.at(sample(position), before, position)[0]
        position[joint] = limit[joint]
        assert LOOK.at(sample(position), before + (position - before) / 2, position)[0]


@pytest.mark.parametrize('joint', range(7))
@pytest.mark.parametrize('sign', [-1.0, 1.0])
def test_torque_at_the_limit_of_any_joint_strains(joint, sign):
    for share, strained in ((1.0, True), (0.999, False)):
        torque = np.zeros(7)
        torque[joint] = sign * share * TORQUE_MAX[joint]
        assert LOOK.at(sample(torque=torque), HOME, HOME)[1] == strained


def test_the_tip_and_its_force_are_the_plain_ones():
    rng, plain = np.random.default_rng(6), TipEstimate(KINEMATICS)
    for _ in range(50):
        q = rng.uniform(0.7 * LIMITS.position_min, 0.7 * LIMITS.position_max)
        external = rng.normal(0.0, 5.0, 7)
        _, _, tip, force = LOOK.at(sample(q, external_torque=external), HOME, HOME)
        plain_tip, plain_force = plain.measure(q, external)
        np.testing.assert_array_equal(tip, plain_tip)
        np.testing.assert_allclose(force, plain_force, rtol=1e-6, atol=1e-6)


def test_measurements_may_be_read_only_or_lie_apart_in_memory_or_be_short_floats():
    position, external = np.repeat(HOME + 1e-3, 2)[::2], np.linspace(0.0, 3.0, 7)
    external.flags.writeable = False
    one = sample(position, external_torque=external, torque=np.zeros(7, dtype=np.float32))
    fine, strained, tip, force = LOOK.at(one, HOME, HOME)
    assert fine
    assert not strained
    plain_tip, plain_force = TipEstimate(KINEMATICS).measure(position, external)
    np.testing.assert_array_equal(tip, plain_tip)
    np.testing.assert_allclose(force, plain_force, rtol=1e-9)


@pytest.mark.parametrize('field', FIELDS)
@pytest.mark.parametrize('shape', [(6,), (8,), (7, 1), ()])
def test_nothing_of_another_shape_is_in_order(field, shape):
    one = replace(sample(HOME + 1e-3), **{field: np.zeros(shape)})
    fine, _, tip, force = LOOK.at(one, HOME, HOME)
    assert not fine
    assert np.isnan([*tip, *force]).all()
    assert watch().judge(one, HOME) is Condition.BAD_SAMPLE
