# SPDX-License-Identifier: Apache-2.0
"""Every node of the graph can be configured more than once, and asked for its parameters."""

from pathlib import Path

import pytest
import rclpy
from rclpy.lifecycle import TransitionCallbackReturn

from lwr_sim_bridge.bridge_node import BridgeNode
from lwr_tracking.tracker_node import TrackerNode
from srnn_planner.nodes.adapter_node import AdapterNode
from srnn_planner.nodes.planner_node import PlannerNode

SUCCESS = TransitionCallbackReturn.SUCCESS
SCENE = Path(__file__).parents[1] / 'config' / 'scenes' / 'four_waypoints.yaml'


@pytest.mark.parametrize('node_class', [BridgeNode, TrackerNode, AdapterNode, PlannerNode])
def test_a_node_can_be_configured_anew_and_still_knows_its_parameters(node_class):
    needs_scene = node_class in (BridgeNode, PlannerNode)
    rclpy.init(args=['--ros-args', *(['-p', f'scene:={SCENE}'] if needs_scene else [])])
    node = node_class()
    try:
        for _ in range(2):
            assert node.trigger_configure() == SUCCESS, node.failure
            assert node.get_parameter('key_file').value == ''
            assert node.has_parameter('seed') == (node_class is not TrackerNode)
            assert node.trigger_cleanup() == SUCCESS, node.failure
    finally:
        node.destroy_node()
        rclpy.shutdown()
