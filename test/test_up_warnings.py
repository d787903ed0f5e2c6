# SPDX-License-Identifier: Apache-2.0
"""`srnn up` passes on what its nodes warn of: whoever starts a part sees what is missing."""

import signal

import pytest
from srnn_process import STOP_S, commands_in

pytestmark = pytest.mark.slow


def test_a_part_of_the_graph_says_who_is_missing_and_says_it_once(tmp_path):
    with commands_in(tmp_path) as run:
        srnn = run('up', '--only', 'tracker', '--arm', 'mock')
        srnn.wait_for('tracker: nobody publishes')
        srnn.process.send_signal(signal.SIGINT)
        assert srnn.wait(STOP_S) == 0
        (line,) = (line for line in srnn.lines if 'nobody publishes' in line)
        assert '/joint_states (sim_bridge or mock_arm or fri_driver)' in line
        assert '/segment (planner)' in line
