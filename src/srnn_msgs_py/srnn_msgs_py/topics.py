# SPDX-License-Identifier: Apache-2.0
"""Every topic of the graph, once: name, type, quality of service, ends and meaning."""

from dataclasses import dataclass

from srnn_msgs_py.errors import UnknownTopicError
from srnn_msgs_py.ownership import COMMAND, KEYED, MOVING, Ownership
from srnn_msgs_py.qos import EVENT, HISTORY, LATCHED, MOTION, SENSOR, Qos

ARMS = ('sim_bridge', 'mock_arm', 'fri_driver')
"""The nodes that can stand for the arm, one at a time."""

DECIDING = ('tracker', 'adapter', 'planner')
"""The nodes whose decisions can be replayed."""

NODES = ('planner', 'adapter', 'tracker', *ARMS, 'fri_emulator')
"""The nodes of the graph; every other name in the table is a person or a tool."""


@dataclass(frozen=True)
class Topic:
    """One row of the table.

    Attributes:
        name: relative name; a leading slash makes it absolute.
        type_name: ROS type, for example ``std_msgs/msg/Float64MultiArray``.
        qos: how it travels.
        publishers: who writes it.
        subscribers: who reads it.
        meaning: one line for the user.
        ownership: how its messages tell who sent them; None for not at all.

    """

    name: str
    type_name: str
    qos: Qos
    publishers: tuple[str, ...]
    subscribers: tuple[str, ...]
    meaning: str
    ownership: Ownership | None = None


TOPICS = (
    Topic(
        'waypoints', 'geometry_msgs/msg/PoseArray', LATCHED, ('user',), ('planner',),
        'tour of way points, replaces the one of the configuration',
    ),
    Topic(
        'segment', 'trajectory_msgs/msg/JointTrajectory', MOTION,
        ('planner',), ('tracker', 'adapter'),
        'next planned motion of the tip; its stamp is its identity', MOVING,
    ),
    Topic(
        'executed', 'trajectory_msgs/msg/JointTrajectory', EVENT,
        ('tracker',), ('planner', 'adapter'),
        'measured path of the tip, with the stamp of its segment', KEYED,
    ),
    Topic(
        'segment_result', 'diagnostic_msgs/msg/DiagnosticStatus', EVENT,
        ('tracker',), ('planner', 'sim_bridge', 'fri_emulator', 'user', 'view'),
        'how a segment ended: DONE, BLOCKED, REJECTED, STALE or FAULT, and why', KEYED,
    ),
    Topic(
        'weights', 'std_msgs/msg/Float32MultiArray', LATCHED, ('adapter',), ('planner',),
        'recurrent weights that differ from the prior, with version and checksum', KEYED,
    ),
    Topic(
        'weights_refused', 'std_msgs/msg/Int64MultiArray', LATCHED, ('planner',), ('adapter',),
        'version with which nothing can be planned, the good one before it, and why', KEYED,
    ),
    Topic(
        'dissonance', 'std_msgs/msg/Float32MultiArray', EVENT,
        ('adapter',), ('planner', 'user', 'view'),
        'learning signal of a segment and whether it changed the weights', KEYED,
    ),
    Topic(
        'current_pose', 'geometry_msgs/msg/PoseStamped', MOTION,
        ('tracker',), ('planner', 'view'),
        'measured tip at 50 Hz', KEYED,
    ),
    Topic(
        'joint_states', 'sensor_msgs/msg/JointState', MOTION,
        ARMS, ('tracker', 'view'),
        'measured joint angles, velocities and torques (effort)', KEYED,
    ),
    Topic(
        'external_torque/joint_states', 'sensor_msgs/msg/JointState', MOTION,
        ARMS, ('tracker',),
        "the arm's own estimate of the external joint torques (effort)", KEYED,
    ),
    Topic(
        'wrench', 'geometry_msgs/msg/WrenchStamped', MOTION, ARMS, ('view',),
        'estimated force on the tool',
    ),
    Topic(
        'forward_position_controller/commands', 'std_msgs/msg/Float64MultiArray', MOTION,
        ('tracker',), ARMS,
        'joint angles to go to, at the rate of the joint states', COMMAND,
    ),
    Topic(
        'contact_truth', 'geometry_msgs/msg/WrenchStamped', SENSOR,
        ('sim_bridge', 'fri_emulator'), ('user',),
        'true contact force of the simulator, for scoring only',
    ),
    Topic(
        'segment_path', 'nav_msgs/msg/Path', EVENT, ('adapter',), ('view',),
        'planned path for display',
    ),
    Topic(
        'executed_path', 'nav_msgs/msg/Path', EVENT, ('adapter',), ('view',),
        'measured path for display',
    ),
    Topic(
        'markers', 'visualization_msgs/msg/MarkerArray', LATCHED, ('planner',), ('view',),
        'way points and target for display',
    ),
    Topic(
        'samples', 'std_msgs/msg/Float32MultiArray', SENSOR, ('planner',), ('view',),
        'imagined movements behind a segment, those first that became it; if somebody listens',
    ),
    Topic(
        'spikes', 'std_msgs/msg/UInt8MultiArray', SENSOR, ('planner',), ('view',),
        'how many samples of each neuron spiked in each step; if somebody listens',
    ),
    Topic(
        'belief', 'nav_msgs/msg/OccupancyGrid', LATCHED, ('adapter',), ('view',),
        'map of the learned inhibition for display',
    ),
    Topic(
        'belief_markers', 'visualization_msgs/msg/MarkerArray', LATCHED, ('adapter',), ('view',),
        'the same as columns',
    ),
    *(
        Topic(
            f'{node}/journal', 'std_msgs/msg/Int64MultiArray', HISTORY, (node,), ('view',),
            f'what the {node} has acted on, in order, for replay',
        )
        for node in DECIDING
    ),
    Topic(
        '/diagnostics', 'diagnostic_msgs/msg/DiagnosticArray', EVENT, NODES, ('view',),
        'state and counters of every node, once a second',
    ),
)  # fmt: skip

_BY_NAME = {topic.name: topic for topic in TOPICS}


def topic(name: str) -> Topic:
    """Return the topic with this name.

    Raises:
        UnknownTopicError: the table has none; the message lists those it has.

    """
    try:
        return _BY_NAME[name]
    except KeyError:
        raise UnknownTopicError(
            f'unknown topic {name!r}; valid topics: {", ".join(_BY_NAME)}'
        ) from None


def markdown_table() -> str:
    """Return the table in Markdown, as the README shows it."""
    lines = [
        '| topic | type | from → to | QoS | marked | meaning |',
        '|---|---|---|---|---|---|',
    ]
    for row in TOPICS:
        ends = f'{", ".join(row.publishers)} → {", ".join(row.subscribers)}'
        short_type = row.type_name.replace('/msg/', '/')
        marked = row.ownership.words() if row.ownership else ''
        cells = (f'`{row.name}`', short_type, ends, row.qos.words(), marked, row.meaning)
        lines.append(f'| {" | ".join(cells)} |')
    return '\n'.join(lines) + '\n'
