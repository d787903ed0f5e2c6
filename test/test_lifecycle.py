# SPDX-License-Identifier: Apache-2.0
"""What is on the wire in each state is what docs/lifecycle.md says."""

from collections import Counter
from pathlib import Path
import time

import numpy as np
import pytest
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_srvs.srv import Trigger

from lwr_description import JOINT_NAMES
from srnn_bringup.config import Choices, load
from srnn_bringup.graph import NAMES
from srnn_bringup.lifecycle_client import LifecycleClient
from srnn_bringup.live_graph import LiveGraph
from srnn_msgs_py.joints import JointSample
from srnn_msgs_py.ros import commands, joints, pose, waypoints
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.tip import TipPosition
from srnn_msgs_py.topics import TOPICS, topic
from srnn_msgs_py.waypoints import Waypoints
from srnn_node.signals import StopRequest

PAGE = Path(__file__).parents[1] / 'docs' / 'lifecycle.md'
PATIENCE_S = 60.0
LISTEN_S = 2.5
"""Health is told once a second."""


@pytest.mark.parametrize('name', NAMES)
def test_the_page_names_what_an_active_node_publishes(name):
    published = ', '.join(f'`{row.name}`' for row in TOPICS if name in row.publishers)
    assert f'| `{name}` | `/diagnostics` | {published} |' in PAGE.read_text()


def pokes() -> list[tuple[str, object]]:
    """Return messages that make an active node answer, with their topics."""
    now, rest = time.time_ns(), np.zeros(7)
    measured, external = joints.to_msgs(JointSample(now, rest, rest, rest, rest), JOINT_NAMES)
    return [
        ('waypoints', waypoints.to_msg(Waypoints(now, np.zeros((2, 3))))),
        ('current_pose', pose.to_msg(TipPosition(now, np.zeros(3)))),
        ('external_torque/joint_states', external),
        ('joint_states', measured),
        ('forward_position_controller/commands', commands.to_msg(rest)),
    ]


def test_unconfigured_and_inactive_nodes_publish_nothing_but_their_health():
    heard, nodes = Counter(), set()
    every = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
    with StopRequest() as stop, LiveGraph(load(Choices()), stop, lambda _: None) as graph:
        for row in TOPICS:
            graph.node.create_subscription(
                message_type(row.type_name), row.name,
                lambda _, name=row.name: heard.update([name]), every,
            )  # fmt: skip
        row = topic('/diagnostics')
        graph.node.create_subscription(
            message_type(row.type_name), row.name,
            lambda msg: nodes.update((s.name.strip('/'), s.message) for s in msg.status), every,
        )  # fmt: skip
        unconfigured = {(name, 'unconfigured') for name in graph.names}
        assert graph.pump.until(lambda: nodes >= unconfigured, PATIENCE_S), nodes
        graph.pump.until(lambda: False, LISTEN_S)
        assert set(heard) == {'/diagnostics'}

        graph.configure()
        senders = {
            name: graph.node.create_publisher(type(message), name, profile(topic(name).qos))
            for name, message in pokes()
        }
        revert = graph.node.create_client(Trigger, 'adapter/revert')
        matched = [*(lambda p=p: p.get_subscription_count() >= 2 for p in senders.values())]
        matched.append(revert.service_is_ready)
        assert graph.pump.until(lambda: all(ready() for ready in matched), PATIENCE_S)
        answer = revert.call_async(Trigger.Request())
        for _ in range(3):
            for name, message in pokes():
                senders[name].publish(message)
            graph.pump.until(lambda: False, 0.1)
        assert graph.pump.until(answer.done, PATIENCE_S)
        graph.pump.until(lambda: False, LISTEN_S)
        assert nodes >= {(name, 'inactive') for name in graph.names}
        del heard['/diagnostics']
        assert heard == Counter(dict.fromkeys(senders, 3))


def test_a_paused_graph_is_shut_down_in_order(monkeypatch):
    asked = []
    with StopRequest() as stop, LiveGraph(load(Choices()), stop, lambda _: None) as graph:
        graph.configure()
        graph.activate()
        for client in reversed(graph._clients[1:]):
            client.change('deactivate', graph.pump, PATIENCE_S)
        graph.pump.until(lambda: False, 0.5)
        monkeypatch.setattr(
            LifecycleClient, 'change', lambda client, name, *_: asked.append((client.name, name))
        )
    assert asked == [('sim_bridge', 'deactivate')]
