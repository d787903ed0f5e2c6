# SPDX-License-Identifier: Apache-2.0
"""The arms that the graph can move, and the nodes that stand for each of them."""

import socket
from typing import TYPE_CHECKING

from srnn_bringup.choices import FRI, SIMULATED
from srnn_bringup.node_description import NodeDescription
from srnn_config import to_mapping

if TYPE_CHECKING:
    from srnn_bringup.config import Configuration

MOCK = 'mock'

ARMS = {
    SIMULATED: 'the MuJoCo arm',
    FRI: 'the real LWR 4+ over FRI',
    MOCK: 'an arm that obeys perfectly, without physics',
}
"""Meaning of the names of the arms."""

ARM_NODES = ('sim_bridge', 'mock_arm', 'fri_emulator', 'fri_driver')
"""All nodes that stand for an arm, in the order of their bring-up."""

HOLDING = ('sim_bridge', 'mock_arm', 'fri_emulator')
"""Those that hold the pose of the arm while they are active, whether commands come or not."""


def describe_arm(configuration: 'Configuration') -> tuple[NodeDescription, ...]:
    """Return the nodes that stand for the arm, in the order in which they are brought up."""
    arm, scene = to_mapping(configuration.arm), str(configuration.scene_path)
    mount = arm['mount']
    if configuration.robot == SIMULATED:
        return (
            NodeDescription(
                'sim_bridge', 'lwr_sim_bridge', 'sim_bridge', 'lwr_sim_bridge.bridge_node',
                {'scene': scene, 'seed': configuration.seed, **arm},
            ),
        )  # fmt: skip
    if configuration.robot == MOCK:
        return (
            NodeDescription(
                'mock_arm', 'lwr_sim_bridge', 'mock_arm', 'lwr_sim_bridge.mock_arm_node',
                {'scene': scene, 'mount': mount, 'guard': arm['arm']['guard']},
            ),
        )  # fmt: skip
    return _describe_fri(configuration)


def _describe_fri(configuration: 'Configuration') -> tuple[NodeDescription, ...]:
    arm, fri = to_mapping(configuration.arm), to_mapping(configuration.fri.fri)
    nodes: tuple[NodeDescription, ...] = ()
    if configuration.emulated:
        # So that it meets neither a real controller nor another emulated one.
        fri['link'].update(port=_free_udp_port(), controller='127.0.0.1')
        nodes += (
            NodeDescription(
                'fri_emulator', 'lwr_sim_bridge', 'fri_emulator',
                'lwr_sim_bridge.fri.emulator_node',
                {
                    'scene': str(configuration.scene_path),
                    'seed': configuration.seed,
                    'driver': '127.0.0.1',
                    'port': fri['link']['port'],
                    'cycle': round(1e3 * configuration.fri.fri.link.cycle),
                    'handshake': configuration.fri.fri.link.handshake,
                    **arm,
                    'controller': to_mapping(configuration.fri.emulator),
                },
            ),
        )  # fmt: skip
    return (
        *nodes,
        NodeDescription(
            'fri_driver', 'lwr_fri_driver', 'fri_driver', 'lwr_fri_driver.driver_node',
            {'mount': arm['mount'], 'fri': fri},
        ),
    )  # fmt: skip


def _free_udp_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(('127.0.0.1', 0))
        port: int = probe.getsockname()[1]
    return port
