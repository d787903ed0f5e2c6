# SPDX-License-Identifier: Apache-2.0
"""The emulated controller says in which mode it is, and why it has stopped."""

import numpy as np
import pytest

from lwr_description import Mount
from lwr_sim_bridge import ArmParameters, SimulatedArm
from lwr_sim_bridge.fri.controller import COMMAND, FriController
from lwr_sim_bridge.fri.emulator_health import emulator_health
from lwr_sim_bridge.fri.krl_program import KrlProgram
from lwr_sim_bridge.fri.parameters import ControllerParameters
from srnn_config.scene import Scene, SceneTask
from srnn_msgs_py.health import HealthLevel

SCENE = Scene(SceneTask('free'), waypoints=((0.0, 0.0),))


@pytest.fixture
def controller():
    arm = SimulatedArm(ArmParameters(), Mount(), SCENE, np.random.default_rng(1))
    return FriController(arm, Mount(), 5, KrlProgram('ros_control'), ControllerParameters())


def test_the_mode_is_told_with_the_figures_of_the_link(controller):
    controller.receive(b'no command', 0.0)
    health = emulator_health(controller, 40, 2)
    assert (health.level, health.message) == (HealthLevel.OK, 'monitor mode')
    assert health.values == {
        'state': 'MONITOR', 'quality': 'UNACCEPTABLE', 'cycles': 40, 'overruns': 2,
        'answer_rate': 0.0, 'latency_ms': 0.0, 'misses': 0, 'late': 0, 'rejected': 1,
    }  # fmt: skip
    controller.state = COMMAND
    health = emulator_health(controller, 41, 2)
    assert (health.message, health.values['state']) == ('command mode', 'COMMAND')


def test_a_stop_is_an_error_until_it_is_acknowledged(controller):
    controller.fail('FRI: the link is too poor')
    health = emulator_health(controller, 0, 0)
    assert (health.level, health.message) == (HealthLevel.ERROR, 'FRI: the link is too poor')
    controller.acknowledge()
    assert emulator_health(controller, 0, 0).level is HealthLevel.OK
