# SPDX-License-Identifier: Apache-2.0
from hypothesis import given, settings
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_description import POSITION_MAX, VELOCITY_MAX
from lwr_fri_driver.core.follower import SPARE, Follower
from lwr_fri_driver.core.joint_velocity import JointVelocity
from lwr_guard import GuardParameters, Refusal

CYCLE = 0.005
GUARD = GuardParameters(CYCLE, 0.02)
START = (0.0, -0.5, 0.25, 1.5, 0.0, 0.5, 0.0)


@settings(deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0.0, 1.0), st.floats(0.001, 0.05))
def test_no_step_is_ever_longer_than_the_limit_whatever_comes_when(seed, share, time_constant):
    rng = np.random.default_rng(seed)
    follower = Follower(GUARD, START, time_constant)
    last, now = np.array(START), 0.0
    for _ in range(100):
        cycles = int(rng.integers(1, 9))
        now += cycles * CYCLE
        for _ in range(rng.integers(0, 4)):
            follower.offer(last + rng.normal(0.0, 0.02, 7), now)
        if rng.random() < 0.01:
            follower.halt()
        position = np.array(follower.advance(cycles, now, share))
        step = SPARE * share * CYCLE * VELOCITY_MAX
        assert (np.abs(position - last) <= step + 1e-12).all()
        assert (np.abs(position) <= POSITION_MAX).all()
        last = position


@pytest.mark.parametrize('time_constant', [0.002, 0.004, 0.02])
def test_a_halt_neither_overshoots_nor_comes_back(time_constant):
    follower = Follower(GUARD, START, time_constant)
    q, now = np.array(START), 0.0
    for _ in range(100):
        now += CYCLE
        q[0] += 0.5 * CYCLE
        follower.offer(q, now)
        moving = follower.advance(1, now, 1.0)[0]
    follower.halt()
    path = [moving]
    while not follower.at_rest:
        now += CYCLE
        path.append(follower.advance(1, now, 1.0)[0])
        assert len(path) < 500
    steps = np.diff(path)
    assert (steps >= -1e-9).all()
    assert steps.max() <= 0.5 * CYCLE * 1.001
    assert 0.0 < path[-1] - moving <= 0.5 * 2.0 * time_constant
    assert follower.offer(q + 0.001, now) is None
    assert follower.advance(1, now, 1.0)[0] == pytest.approx(path[-1], abs=1e-5)


def test_a_command_far_from_where_the_controller_stands_is_refused():
    follower = Follower(GUARD, START, 0.004)
    assert follower.offer(np.array(START) + 0.1, 0.0) is Refusal.TOO_FAR
    assert follower.advance(1, CYCLE, 1.0) == START


def test_velocity_is_exact_on_a_ramp_whatever_is_missing():
    velocity = JointVelocity(CYCLE, 0.0)
    position, slope = np.array(START), np.arange(7.0)
    assert not velocity.update(position, 1).any()
    for cycles in (1, 3, 1, 2):
        position += cycles * CYCLE * slope
        assert np.allclose(velocity.update(position, cycles), slope, rtol=0, atol=1e-12)


def test_the_low_pass_has_its_time_constant():
    velocity = JointVelocity(CYCLE, 0.05)
    position = np.zeros(7)
    velocity.update(position, 1)
    for _ in range(10):
        position += CYCLE
        reached = velocity.update(position, 1)[0]
    assert reached == pytest.approx(1.0 - (1.0 / 1.1) ** 10, abs=1e-12)
