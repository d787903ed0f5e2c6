# SPDX-License-Identifier: Apache-2.0
"""Row 24: physics that goes wrong ends the sim bridge, loudly, before it can report nonsense."""

from collections.abc import Callable, Iterator
import os
from pathlib import Path
import re
import subprocess
import sys
import time

from arm_rig import PHYSICS_PER_TICK
from breaking_bridge import POISONS
from moving_arm import generator, random_course
import pytest
import rclpy
from rclpy.experimental import EventsExecutor

from lwr_sim_bridge import SimulationError
from lwr_tracking.core.failsafe import Condition
from lwr_tracking.tracker_node import TrackerNode
from srnn_node.loop import Loop

HERE = Path(__file__).parent
SCENE = HERE.parents[1] / 'config' / 'scenes' / 'four_waypoints.yaml'
CYCLE_MS = 4.0
PATIENCE_S = 60.0
ALONE = ['-r', f'__ns:=/faults_{os.getpid()}']
"""Whatever else runs on this machine in the same domain is not heard."""


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """MuJoCo writes its warnings to the current directory."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize('what', POISONS)
def test_broken_physics_is_noticed_before_it_is_reported(ledger, what):
    for repeat in range(ledger.repeats):
        rng = generator(what, repeat)
        course = random_course(rng)
        with ledger.injection(24, what, bound_ms=CYCLE_MS) as entry:
            made = course.begin()
            at = made.arm.time
            POISONS[what](made.arm, int(rng.integers(7)))
            with pytest.raises(SimulationError) as caught:
                made.arm.step(PHYSICS_PER_TICK)
            entry.reaction_ms = 1e3 * (made.arm.time - at)
            assert f'simulated arm at {made.arm.time:.3f} s: ' in str(caught.value)
            assert '\n' not in str(caught.value)


class Listening:
    """A tracker in this process, served as `srnn_node.run` would."""

    def __init__(self) -> None:
        rclpy.init(args=['--ros-args', *ALONE])
        self.node = TrackerNode()
        self._executor = EventsExecutor()
        self._executor.add_node(self.node)
        self._loop = Loop(self.node, self._executor)
        self.node.trigger_configure()
        self.node.trigger_activate()

    def until(self, condition: Callable[[], object]) -> None:
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end, 'waited in vain'
            self._loop.turn()

    def close(self) -> None:
        # An active node keeps the garbage collector out, and with it its own end.
        self.node.trigger_deactivate()
        self.node.trigger_cleanup()
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown()


@pytest.fixture
def tracker() -> Iterator[Listening]:
    listening = Listening()
    yield listening
    listening.close()


@pytest.fixture
def bridge() -> Iterator[Callable[[str], subprocess.Popen]]:
    started = []

    def start(how: str) -> subprocess.Popen:
        options = ['-p', f'scene:={SCENE}', '-p', 'autostart:=true', *ALONE]
        started.append(subprocess.Popen(
            [sys.executable, HERE / 'breaking_bridge.py', how, '--ros-args', *options],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        ))  # fmt: skip
        return started[-1]

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.communicate()


def test_the_bridge_ends_in_one_line_and_the_tracker_stops(ledger, tracker, bridge):
    for repeat in range(ledger.repeats):
        how = list(POISONS)[generator('process', repeat).integers(len(POISONS))]
        with ledger.injection(24, 'physics of the bridge process goes wrong'):
            process = bridge(how)
            tracker.until(lambda: tracker.node._session.tracker.latched)
            # The last measurement was that of a sound arm.
            assert tracker.node._session.tracker.conditions == Condition.SILENT
            assert process.wait(PATIENCE_S) == 1
            said = process.stderr.read()
            assert re.search(r'^BreakingBridge: simulated arm at \d+\.\d+ s: ', said, re.M), said
            assert 'Traceback' not in said
            tracker.node._reset()
