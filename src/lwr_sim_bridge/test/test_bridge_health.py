# SPDX-License-Identifier: Apache-2.0
"""What the bridge says of itself when commands are missing."""

from collections.abc import Iterator
from pathlib import Path
import time

import pytest
import rclpy

from lwr_sim_bridge.arm_node import TICKS_PER_CYCLE
from lwr_sim_bridge.bridge_node import BridgeNode
from srnn_msgs_py.health import HealthLevel
from srnn_node.rate import RateKeeper

SCENE = Path(__file__).parents[3] / 'config' / 'scenes' / 'four_waypoints.yaml'


@pytest.fixture
def bridge() -> Iterator[BridgeNode]:
    rclpy.init(args=['--ros-args', '-p', f'scene:={SCENE}'])
    node = BridgeNode()
    node.trigger_configure()
    node.trigger_activate()
    yield node
    node.destroy_node()
    rclpy.shutdown()


@pytest.mark.parametrize(('missing', 'level', 'message'), [
    (0, HealthLevel.OK, ''),
    (5, HealthLevel.OK, ''),
    (6, HealthLevel.WARN, 'only 94% of the cycles bring a command'),
    (10, HealthLevel.WARN, 'only 90% of the cycles bring a command'),
    (11, HealthLevel.ERROR, 'only 89% of the cycles bring a command'),
])  # fmt: skip
def test_missing_commands_are_a_warning_and_many_an_error(bridge, missing, level, message):
    home = bridge._arm.sample(0).position
    for cycle in range(200):
        if not (cycle % 4 == 1 and cycle % 100 < 4 * missing):
            bridge._on_command(home)
        bridge._arm.step(TICKS_PER_CYCLE)
    health = bridge.health()
    assert (health.level, health.message) == (level, message)
    assert health.values['commands_answered'] == pytest.approx(1.0 - missing / 100)


def test_commands_that_have_ceased_are_told_as_such(bridge):
    bridge._on_command(bridge._arm.sample(0).position)
    bridge._arm.step(100)
    assert bridge.health().message == 'no commands: the arm holds its pose'


def test_cycles_given_up_are_told_once(bridge):
    bridge._rate = RateKeeper(0.004, time.monotonic() - 10.0, 3)
    bridge.on_tick()
    told = bridge.health()
    assert told.level is HealthLevel.WARN
    assert told.message == f'cycles given up: {bridge._rate.skipped}'
    assert bridge._rate.skipped > 2000
    assert bridge.health().level is HealthLevel.OK
