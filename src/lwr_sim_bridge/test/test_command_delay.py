# SPDX-License-Identifier: Apache-2.0
"""Commands arrive late by a whole number of ticks, and that is all that happens to them."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st
import numpy as np
import pytest

from lwr_description import Kinematics, Mount
from lwr_sim_bridge import ArmParameters, CommandParameters, SimulatedArm
from lwr_sim_bridge.command_delay import CommandDelay
from srnn_config import ConfigError
from srnn_config.scene import build_scene

MOUNT = Mount()


def delayed(seconds):
    """Return an arm at rest whose commands are late."""
    command = CommandParameters(delay=seconds)
    scene = build_scene({'name': 'free', 'waypoints': [[0.0, 0.0]]}, 'test')
    parameters = replace(ArmParameters(), command=command)
    return SimulatedArm(parameters, MOUNT, scene, np.random.default_rng(3))


def trace(arm, waiting, ticks=120):
    """Command a ramp after `waiting` ticks; return the true joint angles (ticks, 7) [rad]."""
    kinematics, angles = Kinematics(MOUNT), []
    for tick in range(ticks):
        step = tick - waiting
        if step >= 0 and step % 4 == 0:
            assert arm.command(kinematics.inverse([4e-4 * step / 4, 0.0, 0.0])) is None
        arm.step()
        angles.append(arm.data.qpos.copy())
    return np.array(angles)


@given(late=st.integers(0, 20), given_at=st.sets(st.integers(0, 60)))
def test_every_command_arrives_exactly_so_many_ticks_later(late, given_at):
    delay = CommandDelay(late)
    arrived = {}
    for tick in range(90):
        if tick in given_at:
            delay.give(np.full(7, float(tick)))
        q = delay.due()
        if q is not None:
            arrived[tick] = q[0]
    assert arrived == {tick + late: float(tick) for tick in given_at}


@given(late=st.integers(0, 20), given_at=st.sets(st.integers(0, 60)), most=st.integers(1, 8))
def test_ticks_in_which_nothing_arrives_may_be_skipped(late, given_at, most):
    delay, tick, arrived = CommandDelay(late), 0, {}
    while tick < 90:
        if tick in given_at:
            delay.give(np.full(7, float(tick)))
        q = delay.due()
        if q is not None:
            arrived[tick] = q[0]
        until_given = min((t for t in given_at if t > tick), default=90) - tick - 1
        skipped = min(most, delay.quiet, until_given)
        delay.skip(skipped)
        tick += 1 + skipped
    assert arrived == {tick + late: float(tick) for tick in given_at}


def test_of_commands_that_arrive_together_the_last_counts():
    delay = CommandDelay(0)
    q = np.zeros(7)
    delay.give(q)
    q[:] = 1.0
    delay.give(q)
    q[:] = 2.0
    assert delay.due().tolist() == [1.0] * 7
    assert delay.due() is None


@pytest.mark.parametrize('ticks', [0, 1, 12])
def test_a_late_command_is_one_that_is_given_later(ticks):
    """Bit for bit: the sensor noise belongs to the tick, not to the command."""
    late = trace(delayed(1e-3 * ticks), waiting=10)
    assert np.array_equal(late, trace(delayed(0.0), waiting=10 + ticks))
    assert not np.array_equal(late, trace(delayed(0.0), waiting=11 + ticks))


def test_no_delay_unless_somebody_asks_for_it():
    assert ArmParameters().command.delay == 0.0


@pytest.mark.parametrize('seconds', [-0.001, 0.051, float('nan')])
def test_an_impossible_delay_is_refused_with_its_bounds(seconds):
    with pytest.raises(ConfigError, match=r'delay = .*>= 0 and <= 0.05 \[s\]'):
        CommandParameters(delay=seconds)
