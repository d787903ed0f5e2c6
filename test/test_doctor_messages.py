# SPDX-License-Identifier: Apache-2.0
"""The doctor has a message really sent, and sees who else is in the domain."""

import os
import subprocess
import sys

from srnn_bringup.doctor.messages import exchange
from srnn_bringup.environment import graph_environment

STRANGER = """
import rclpy, sys
rclpy.init()
node = rclpy.create_node('stranger')
print('here', flush=True)
sys.stdin.read()
"""


def test_a_message_arrives_and_nobody_else_is_seen():
    heard = exchange(os.environ)
    assert not heard.failure
    assert (heard.middleware, heard.others) == ('rmw_fastrtps_cpp', ())


def test_another_node_of_the_domain_is_seen():
    with subprocess.Popen(
        [sys.executable, '-c', STRANGER], env=graph_environment(os.environ), text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
    ) as stranger:  # fmt: skip
        assert stranger.stdout.readline() == 'here\n'
        heard = exchange(os.environ)
        stranger.stdin.close()
    assert heard.others == ('stranger',)


def test_a_middleware_that_is_not_there_is_told():
    heard = exchange({**os.environ, 'RMW_IMPLEMENTATION': 'rmw_nowhere'})
    assert 'the middleware does not start' in heard.failure
    assert 'rmw_nowhere' in heard.failure
