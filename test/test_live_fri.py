# SPDX-License-Identifier: Apache-2.0
"""The graph over FRI: the driver and an emulated controller as processes, UDP between them."""

from collections.abc import Iterator
import json
import os
from pathlib import Path
import signal
import time

import numpy as np
import pytest
from srnn_process import SCENE, STOP_S
from std_srvs.srv import Trigger
from watched_graph import Watched, free_scene, over, watched_graph

from lwr_fri_driver.core.phase import Phase
from srnn_bringup.config import FRI, Choices, load
from srnn_bringup.demo import Outputs, run_demo
from srnn_bringup.restarts import Restarts
from srnn_node.realtime import prefer_thread

pytestmark = pytest.mark.slow

SEGMENTS = 24


def loop_process(driver: int) -> int:
    """Return the process that answers the controller for a driver node."""
    (child,) = Path(f'/proc/{driver}/task/{driver}/children').read_text().split()
    assert 'lwr_fri_driver.loop_process' in Path(f'/proc/{child}/cmdline').read_text()
    return int(child)


def may_hurry() -> bool:
    """Tell whether the process that answers the controller gets the priority it asks for."""
    granted = prefer_thread(1)
    if granted:
        prefer_thread(0)
    return granted


@pytest.mark.skipif(
    not may_hurry(), reason='no SCHED_FIFO here: a busy machine takes the arm from its commands'
)
def test_the_demo_learns_within_the_bounds_of_the_simulated_arm(tmp_path, capfd):
    (tmp_path / 'wall.yaml').write_text(SCENE)
    configuration = over(FRI, load(Choices(scene=str(tmp_path / 'wall.yaml'), seed=2)))
    outputs = Outputs(picture=tmp_path / 'demo.png', json=tmp_path / 'demo.json', weights=None)
    assert run_demo(configuration, SEGMENTS, outputs) == 0, capfd.readouterr().out
    (trial,) = json.loads((tmp_path / 'demo.json').read_text())['trials']
    assert set(trial['nodes']) == {'fri_emulator', 'fri_driver', 'tracker', 'adapter', 'planner'}
    assert 1 <= trial['contacts'] <= 12
    assert 1 <= trial['updates_triggered'] <= 15
    assert not [n for n in trial['contact_segments'] if n > 2 * SEGMENTS / 3]
    assert trial['invalid_plans'] == 0
    assert trial['tracking_rmse_m'] <= 0.002
    assert 1.0 < trial['contact_force_peak_n'] <= 60.0


@pytest.fixture
def watched(tmp_path: Path) -> Iterator[Watched]:
    configuration = over(FRI, free_scene(tmp_path, velocity=0.1))
    with watched_graph(configuration, Restarts()) as value:
        yield value


def phase(watched: Watched) -> str:
    return watched.health['fri_driver'][-1][1].values.get('phase', '')


def moves_on(watched: Watched) -> None:
    """Reset driver and tracker, and wait for segments that were sent after that."""
    resting = watched.joints[-1][1]
    assert watched.call(Trigger, 'fri_driver/reset').success
    watched.until(lambda: phase(watched) == Phase.COMMANDING.name)
    watched.spin(0.5)
    assert np.abs(watched.joints[-1][1] - resting).max() < 0.005
    began = watched.now()
    assert watched.call(Trigger, 'tracker/reset').success
    watched.first_executed(began)


def test_a_controller_that_falls_silent_stops_all_until_both_are_reset(watched):
    emulator = watched.graph.pids['fri_emulator']
    os.kill(emulator, signal.SIGSTOP)
    watched.until(lambda: phase(watched) == Phase.FAULT.name)
    assert watched.health['fri_driver'][-1][1].message == 'the controller has fallen silent'
    os.kill(emulator, signal.SIGCONT)
    watched.spin(3.0)
    assert phase(watched) == Phase.FAULT.name
    assert watched.call(Trigger, 'fri_emulator/acknowledge').success
    watched.spin(1.0)
    assert phase(watched) == Phase.FAULT.name
    moves_on(watched)


def test_a_driver_that_is_killed_leaves_the_arm_at_rest_and_its_successor_begins_anew(watched):
    loop = loop_process(watched.graph.pids['fri_driver'])
    killed = watched.kill('fri_driver')
    # The process that answers the controller outlives its node, until the arm has come to rest.
    watched.until(lambda: not Path(f'/proc/{loop}').exists(), STOP_S)
    watched.until(
        lambda: any(
            t > killed and health.message == 'monitor mode'
            for t, health in watched.health['fri_emulator']
        )
    )
    watched.until(
        lambda: any(t > killed for t, _ in watched.health['fri_driver'])
        and phase(watched) == Phase.COMMANDING.name
    )
    began = watched.now()
    assert watched.call(Trigger, 'tracker/reset').success
    watched.first_executed(began)


def test_a_process_that_answers_no_more_ends_its_node_which_is_started_anew(watched):
    node = watched.graph.pids['fri_driver']
    os.kill(loop_process(node), signal.SIGKILL)
    watched.until(lambda: 'too many answers' in watched.health['fri_emulator'][-1][1].message)
    watched.until(lambda: watched.graph.pids['fri_driver'] != node)
    assert watched.call(Trigger, 'fri_emulator/acknowledge').success
    since = time.time_ns()
    watched.until(
        lambda: watched.health['fri_driver'][-1][0] > since
        and phase(watched) == Phase.COMMANDING.name
    )
    began = watched.now()
    assert watched.call(Trigger, 'tracker/reset').success
    watched.first_executed(began)
