# SPDX-License-Identifier: Apache-2.0
"""What an arm cannot have measured is not believed."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_description import POSITION_MAX, VELOCITY_MAX, ArmDescription
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.core.joint_watch import JointWatch
from lwr_tracking.core.parameters import WatchParameters
from srnn_msgs_py.joints import JointSample

STEP_NS = 4_000_000
HOME = np.array([0.0, -0.57, 0.0, 1.67, 0.0, 0.68, 0.0])


def sample(number, position=HOME, **changes):
    zero = np.zeros(7)
    measured = JointSample(number * STEP_NS, np.array(position), zero, zero, zero)
    return replace(measured, **changes)


@pytest.fixture
def watch():
    watch = JointWatch(WatchParameters(), ArmDescription().limits, 0.004)
    assert watch.judge(sample(1), HOME) is Condition.NONE
    return watch


@pytest.mark.parametrize('field', ['position', 'external_torque'])
@pytest.mark.parametrize('value', [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize('joint', range(7))
def test_no_number_that_is_not_finite_passes(watch, field, value, joint):
    array = getattr(sample(2), field).copy()
    array[joint] = value
    assert watch.judge(sample(2, **{field: array}), HOME) is Condition.BAD_SAMPLE


@pytest.mark.parametrize('joint', range(7))
def test_angles_beyond_the_limits_are_not_true(watch, joint):
    position = HOME.copy()
    position[joint] = -(POSITION_MAX[joint] + 0.021)
    assert watch.judge(sample(2, position), HOME) is Condition.OUT_OF_RANGE
    watch.restart()
    assert watch.judge(sample(3, position), HOME) is Condition.OUT_OF_RANGE


@given(st.integers(0, 6), st.integers(1, 5), st.floats(0.0, 4.0))
def test_a_joint_may_move_twice_as_fast_as_it_can(joint, missed, share):
    watch = JointWatch(WatchParameters(), ArmDescription().limits, 0.004)
    watch.judge(sample(1), HOME)
    position = HOME.copy()
    position[joint] += share * VELOCITY_MAX[joint] * missed * 0.004
    jumped = watch.judge(sample(1 + missed, position), HOME) is Condition.JUMPED
    assert jumped == (share > 2.0) or share == pytest.approx(2.0)


@pytest.mark.parametrize(('gap', 'farthest'), [(24, 0.0768), (26, 0.03), (250, 0.03)])
def test_an_arm_without_commands_does_not_go_far(gap, farthest):
    slowest = np.argmin(VELOCITY_MAX)
    for share, condition in ((0.99, Condition.NONE), (1.01, Condition.JUMPED)):
        watch = JointWatch(WatchParameters(), ArmDescription().limits, 0.004)
        watch.judge(sample(1), HOME)
        position = HOME.copy()
        position[slowest] -= share * farthest
        assert watch.judge(sample(1 + gap, position), HOME) is condition


@pytest.mark.parametrize('stamp', [-36_000, 900_000])
def test_a_clock_that_is_set_excuses_no_more_than_the_longest_gap(watch, stamp):
    near = HOME + 0.9 * VELOCITY_MAX * 0.004
    far = HOME + 2.1 * VELOCITY_MAX * 0.02
    assert watch.judge(sample(stamp, far), HOME) is Condition.JUMPED
    assert watch.judge(sample(stamp, near), HOME) is Condition.NONE


def test_who_seems_to_have_jumped_is_not_believed_before_a_restart(watch):
    there = HOME + 0.1
    for number in range(2, 200):
        assert watch.judge(sample(number, there), HOME) is Condition.JUMPED
    watch.restart()
    assert watch.judge(sample(200, there), HOME) is Condition.NONE


def test_the_same_angles_count_as_frozen_only_while_the_arm_is_told_to_move(watch):
    for number in range(2, 100):
        assert watch.judge(sample(number), HOME) is Condition.NONE
    told = HOME + 0.0006
    assert watch.judge(sample(100), told) is Condition.NONE
    assert watch.judge(sample(101), told) is Condition.FROZEN
    assert watch.judge(sample(102, HOME + 1e-9), told) is Condition.NONE


def test_a_stamp_that_stands_still_counts_as_frozen_even_at_rest(watch):
    assert watch.judge(sample(1, HOME + 1e-6), HOME) is Condition.NONE
    assert watch.judge(sample(1, HOME - 1e-6), HOME) is Condition.FROZEN


def test_limits_that_are_not_even_about_zero_are_those_of_each_side():
    limits = ArmDescription().limits._replace(position_min=HOME - 0.1, position_max=HOME + 0.2)
    for offset, condition in (
        (-0.11, Condition.NONE), (-0.13, Condition.OUT_OF_RANGE),
        (0.21, Condition.NONE), (0.23, Condition.OUT_OF_RANGE),
    ):  # fmt: skip
        watch = JointWatch(WatchParameters(), limits, 0.004)
        assert watch.judge(sample(1, HOME + offset), HOME) is condition
