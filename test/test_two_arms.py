# SPDX-License-Identifier: Apache-2.0
"""Two arms in one domain, each in a namespace of its own, started as a user starts them."""

from collections.abc import Iterator
from pathlib import Path
import subprocess
import sys

import numpy as np
import pytest
from srnn_process import START_S, STOP_S, commands_in

from srnn_bringup.session import session
from srnn_msgs_py.ros import belief, diagnostics, result, segment, weights
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic

pytestmark = pytest.mark.slow

LEARNED_S = 90.0
PATIENCE_S = 60.0

MIRRORED = """
name: mirrored
waypoints: [[-0.03, 0.0], [0.15, 0.15]]
blocked: 1
obstacles:
  - {shape: box, center: [0.05, 0.06], size: [0.04, 0.12], yaw: -0.7}
"""


class Ear:
    """What is heard of one arm, from outside of its namespace."""

    def __init__(self, node, name: str) -> None:
        self._node, self._name = node, name
        self.segments, self.results, self.weights, self.beliefs = [], [], [], []
        self.listen('segment', lambda msg: self.segments.append(segment.from_msg(msg)))
        self.listen('segment_result', lambda msg: self.results.append(result.from_msg(msg)))
        self.listen('weights', lambda msg: self.weights.append(weights.from_msg(msg)))
        self.listen('belief', lambda msg: self.beliefs.append(belief.from_msg(msg)))

    def listen(self, name, take) -> None:
        row = topic(name)
        kind = message_type(row.type_name)
        full = f'/{self._name}/{name}'
        self._node.create_subscription(kind, full, take, profile(row.qos))

    def learned(self) -> bool:
        weights, beliefs = self.weights, self.beliefs
        return bool(weights and weights[-1].version and beliefs and beliefs[-1][0].any())


@pytest.fixture
def start(tmp_path: Path) -> Iterator:
    (tmp_path / 'mirrored.yaml').write_text(MIRRORED)
    with commands_in(tmp_path) as run:
        yield run


@pytest.fixture
def listener():
    with session('listener', lambda: None) as (node, pump):
        yield node, pump


def command(*arguments: str) -> tuple[int, str]:
    line = [sys.executable, '-m', 'srnn_bringup.cli', *arguments]
    done = subprocess.run(line, capture_output=True, text=True, timeout=PATIENCE_S)
    return done.returncode, done.stdout + done.stderr


def most_avoided(believed) -> np.ndarray:
    """Return where the inhibition is largest [m]."""
    inhibition, corner, cell = believed
    row, column = np.unravel_index(np.argmax(inhibition), inhibition.shape)
    return np.array(corner) + cell * (np.array([column, row]) + 0.5)


def test_two_arms_learn_each_its_own_obstacle(start, listener, tmp_path):
    node, pump = listener
    ears = {name: Ear(node, name) for name in ('left', 'right')}
    graphs = {
        'left': start('up', '--namespace', 'left', '--scene', 'wall.yaml', '--seed', '2'),
        'right': start('up', '--namespace', 'right', '--scene', 'mirrored.yaml', '--seed', '3'),
    }
    for graph in graphs.values():
        graph.wait_for('up: ')
    assert pump.until(lambda: all(ear.learned() for ear in ears.values()), LEARNED_S)
    for ear, side in ((ears['left'], -1.0), (ears['right'], 1.0)):
        assert side * most_avoided(ear.beliefs[-1])[1] > 0.0
        # Nobody has learned from a segment of the other arm.
        own = {plan.stamp_ns for plan in ear.segments}
        assert {w.segment_stamp_ns for w in ear.weights if w.version} <= own

    code, said = command('up', '--namespace', 'left', '--arm', 'mock', '--only', 'tracker')
    assert code == 1
    assert 'another tracker runs there in namespace /left' in said
    code, said = command('pause')
    assert code == 1
    assert 'there is one in namespace /left and /right' in said

    code, said = command('pause', '--namespace', 'right')
    assert code == 0, said
    # What had been said before is heard now.
    pump.until(lambda: False, 1.0)
    seen = {name: len(ear.results) for name, ear in ears.items()}
    assert pump.until(lambda: len(ears['left'].results) >= seen['left'] + 3, PATIENCE_S)
    assert len(ears['right'].results) == seen['right']
    for graph in graphs.values():
        graph.process.terminate()
        assert graph.wait(STOP_S) == 0, graph.text


def test_a_planner_goes_by_what_another_arm_has_learned(start, listener, tmp_path):
    node, pump = listener
    left, right, versions = Ear(node, 'left'), Ear(node, 'right'), {}

    def take(msg) -> None:
        for name, health in diagnostics.from_msg(msg).items():
            versions[name] = health.values.get('weights_version')

    row = topic('/diagnostics')
    kind = message_type(row.type_name)
    node.create_subscription(kind, row.name, take, profile(row.qos))
    teacher = start('up', '--namespace', 'left', '--scene', 'wall.yaml', '--seed', '2')
    teacher.wait_for('up: ')
    assert pump.until(left.learned, LEARNED_S)
    pupil = start(
        'up', '--namespace', 'right', '--scene', 'wall.yaml', '--seed', '3',
        '--only', 'sim_bridge,tracker,planner', '--remap', 'weights:=/left/weights',
        '--record', 'pupil',
    )  # fmt: skip
    pupil.wait_for('up: ')
    assert pump.until(lambda: len(right.results) >= 3, START_S)
    assert not right.weights
    assert pump.until(
        lambda: versions['/right/planner'] == str(left.weights[-1].version), PATIENCE_S
    )
    # What it went by is in its bag, and so its plans can be made again.
    pupil.process.terminate()
    assert pupil.wait(STOP_S) == 0, pupil.text
    code, said = command('replay', str(tmp_path / 'pupil'))
    assert code == 0, said
    assert [line.partition(':')[0] for line in said.splitlines()[:2]] == ['tracker', 'planner']
    assert said.count('identical') == 2
