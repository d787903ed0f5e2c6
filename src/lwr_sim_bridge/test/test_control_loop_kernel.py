# SPDX-License-Identifier: Apache-2.0
"""The compiled control loop is the plain one, noise and contact included."""

import numpy as np
import pytest

from lwr_description import Kinematics, Mount
from lwr_sim_bridge import (
    ArmParameters,
    CommandParameters,
    ObserverParameters,
    SimulatedArm,
    control_loop,
    simulated_arm,
)
from srnn_config.scene import build_scene

MOUNT = Mount()
KINEMATICS = Kinematics(MOUNT)
DEFAULT = ArmParameters()
WALL = {'shape': 'box', 'center': [0.10, 0.0], 'size': [0.1, 0.3]}


def arm(parameters, obstacle=WALL):
    scene = build_scene({'name': 'wall', 'waypoints': [[0, 0]], 'obstacles': [obstacle]}, 'test')
    return SimulatedArm(parameters, MOUNT, scene, np.random.default_rng(4))


def run(parameters=DEFAULT, at_once=4):
    """Run into a wall, lean on it, leave it; return all samples (n, 28) and the peak force."""
    moved = arm(parameters)
    ahead = np.linspace(0.0, 0.045, 100)
    record = []
    for x in (*ahead, *[ahead[-1]] * 50, *ahead[::-1]):
        assert moved.command(KINEMATICS.inverse([x, 0.01, 0.0])) is None
        for _ in range(4 // at_once):
            moved.step(at_once)
        sample = moved.sample(0)
        fields = (sample.position, sample.velocity, sample.torque, sample.external_torque)
        record.append(np.concatenate(fields))
    return np.array(record), moved.truth.peak


@pytest.mark.parametrize('ticks', [1, 2, 3])
def test_the_arm_moves_and_feels_as_with_the_plain_loop(ticks, monkeypatch):
    parameters = ArmParameters(observer=ObserverParameters(ticks=ticks))
    compiled, peak = run(parameters)
    monkeypatch.setattr(simulated_arm, 'ControlLoop', control_loop.ControlLoop)
    plain, plain_peak = run(parameters)
    assert peak > 5.0
    assert peak == pytest.approx(plain_peak, rel=1e-7)
    np.testing.assert_allclose(compiled, plain, rtol=0.0, atol=1e-6)


@pytest.mark.parametrize('delay', [0.0, 0.003, 0.009])
@pytest.mark.parametrize('ticks', [1, 3])
def test_four_ticks_at_once_are_four_single_ones(ticks, delay):
    """Bit for bit, contact included."""
    parameters = ArmParameters(
        observer=ObserverParameters(ticks=ticks), command=CommandParameters(delay=delay)
    )
    samples, peak = run(parameters)
    single, single_peak = run(parameters, at_once=1)
    assert peak == single_peak > 5.0
    np.testing.assert_array_equal(samples, single)


def test_an_obstacle_that_waits_appears_in_the_tick_in_which_the_tool_has_left():
    disc = {'shape': 'disc', 'center': [0.0, 0.0], 'radius': 0.02}
    single, several = arm(DEFAULT, disc), arm(DEFAULT, disc)
    for x in np.linspace(0.0, 0.06, 100):
        for moved in (single, several):
            assert moved.command(KINEMATICS.inverse([x, 0.0, 0.0])) is None
        several.step(4)
        for _ in range(4):
            single.step()
        assert single.obstacles_present == several.obstacles_present
        np.testing.assert_array_equal(single.data.qpos, several.data.qpos)
    assert several.obstacles_present == (0,)
