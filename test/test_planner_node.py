# SPDX-License-Identifier: Apache-2.0
"""The planner's node: what it does with plans that fail and paths that cannot be."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import rclpy
from rclpy.lifecycle import TransitionCallbackReturn

from srnn_msgs_py.health import HealthLevel
from srnn_msgs_py.ros import refusal
from srnn_msgs_py.segment import ExecutedPath
from srnn_msgs_py.tip import TipPosition
from srnn_msgs_py.weights import WeightsUpdate
from srnn_node import garbage
from srnn_planner.core.sequencer import RETRY
from srnn_planner.core.synapses import Synapses
from srnn_planner.nodes import planner_node
from srnn_planner.nodes.planner_node import PlannerNode

SUCCESS = TransitionCallbackReturn.SUCCESS
SCENE = Path(__file__).parents[1] / 'config' / 'scenes' / 'four_waypoints.yaml'
TRIES = 3


@pytest.fixture
def planner(monkeypatch: pytest.MonkeyPatch) -> Iterator[PlannerNode]:
    monkeypatch.setattr(PlannerNode, 'ACTIVE_PRIORITY', 0)
    rclpy.init(args=['--ros-args', '-p', f'scene:={SCENE}', '-p', f'planning.dead_after:={TRIES}'])
    node = PlannerNode()
    assert node.trigger_configure() == SUCCESS
    assert node.trigger_activate() == SUCCESS
    node._on_pose(TipPosition(1, np.array([0.25, 0.25, 0.0])))
    yield node
    node.destroy_node()
    garbage.thaw()
    rclpy.shutdown()


class Clock:
    """Steady time that passes only when told."""

    def __init__(self) -> None:
        self.now = 0.0

    def monotonic(self) -> float:
        return self.now


def test_dead_weights_are_told_of_at_once_to_the_adapter_and_once_to_people(
    planner, monkeypatch
):
    clock, told, logged = Clock(), [], []
    monkeypatch.setattr(planner_node, 'time', clock)
    monkeypatch.setattr(planner._trouble.refused, 'publish', lambda msg: told.append(msg))
    logger = type('Logger', (), {'error': logged.append, 'warning': logged.append})
    monkeypatch.setattr(planner, 'get_logger', lambda: logger)

    def tick() -> HealthLevel:
        clock.now += RETRY
        planner.on_tick()
        return planner.health().level

    synapses = planner._session.planner.synapses
    dead = Synapses.of(synapses.prior, np.full_like(synapses.dense(), -1.0)).learned
    planner._on_weights(WeightsUpdate(7, 0, dead))
    levels = [tick() for _ in range(TRIES)]
    assert levels == [HealthLevel.WARN] * (TRIES - 1) + [HealthLevel.ERROR]
    assert told == []
    assert tick() is HealthLevel.ERROR
    (msg,) = told
    assert refusal.from_msg(msg).refused_version == 7
    assert planner.health().values['weights_version'] == 0
    assert [text.split(':')[0] for text in logged] == [
        f'no valid plan in {TRIES} tries with weights version 7',
        'weights version 7 are dead',
    ]
    planner._on_weights(WeightsUpdate(7, 0, dead))
    assert planner.refused_messages == 1
    planner._on_weights(WeightsUpdate(8, 0, planner._session.planner.synapses.learned))
    assert planner.health().level is HealthLevel.WARN
    assert planner.health().values['weights_version'] == 8
    assert len(told) == 1


@pytest.mark.parametrize('shape', [(5, 3), (5, 1)])
def test_paths_of_another_space_are_refused(planner, shape):
    planner._on_executed(ExecutedPath(1, np.arange(5.0), np.zeros(shape)))
    assert planner.refused_messages == 1


def test_paths_with_holes_are_refused(planner):
    positions = np.zeros((5, 2))
    positions[3, 1] = np.nan
    planner._on_executed(ExecutedPath(1, np.arange(5.0), positions))
    assert planner.refused_messages == 1
    planner._on_executed(ExecutedPath(1, np.arange(5.0), np.zeros((5, 2))))
    assert planner.refused_messages == 1
