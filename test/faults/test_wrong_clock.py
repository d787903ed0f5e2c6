# SPDX-License-Identifier: Apache-2.0
"""Clocks of two hosts that do not agree: nothing moves, and it is said why."""

from pathlib import Path
import subprocess
import sys

import pytest

from srnn_bringup.config import Choices, load
from srnn_bringup.graph import describe, write_parameters
from srnn_bringup.live_graph import LiveGraph
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.ros import result
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_node.signals import StopRequest

PLANNER = Path(__file__).parent / 'late_planner.py'
PATIENCE_S = 60.0
STOP_S = 10.0


@pytest.mark.slow
def test_a_planner_with_a_wrong_clock_moves_nothing_and_says_so(tmp_path):
    configuration = load(Choices())
    parameters = write_parameters(describe(configuration), tmp_path, autostart=True)['planner']
    command = [sys.executable, str(PLANNER), '--ros-args', '--params-file', str(parameters)]
    results, said = [], set()
    others = (None, ('sim_bridge', 'tracker', 'adapter'))
    with StopRequest() as stop, LiveGraph(configuration, stop, lambda _: None, *others) as graph:
        for name, take in (
            ('segment_result', lambda msg: results.append(result.from_msg(msg))),
            ('/diagnostics', lambda msg: said.update((s.name, s.message) for s in msg.status)),
        ):
            row = topic(name)
            kind = message_type(row.type_name)
            graph.node.create_subscription(kind, row.name, take, profile(row.qos))
        graph.configure()
        graph.activate()
        planner = subprocess.Popen(command, stderr=subprocess.DEVNULL)
        try:
            words = 'segments are refused as too old: do the clocks of all hosts agree?'
            assert graph.pump.until(lambda: ('/planner', words) in said, PATIENCE_S), said
        finally:
            planner.terminate()
            planner.wait(STOP_S)
    assert {r.code for r in results} == {ResultCode.STALE}
