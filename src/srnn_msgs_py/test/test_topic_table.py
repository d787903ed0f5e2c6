# SPDX-License-Identifier: Apache-2.0
import pytest
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

from srnn_msgs_py.errors import MessageError, UnknownTopicError
from srnn_msgs_py.qos import PROFILES
from srnn_msgs_py.ros.mark_carrier import mark_carrier
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import NODES, TOPICS, markdown_table, topic

RESTART_S = 0.6
"""No node is back sooner after it was killed."""


def test_every_topic_is_named_once_and_found_by_name():
    assert len({row.name for row in TOPICS}) == len(TOPICS)
    assert all(topic(row.name) is row for row in TOPICS)


@pytest.mark.parametrize('row', TOPICS, ids=lambda row: row.name)
def test_every_topic_has_an_installed_type_two_ends_and_a_meaning(row):
    msg = message_type(row.type_name)()
    assert row.type_name == f'{type(msg).__module__.split(".")[0]}/msg/{type(msg).__name__}'
    assert row.publishers
    assert row.subscribers
    assert set(row.publishers + row.subscribers) <= {*NODES, 'user', 'view'}
    assert row.meaning


def test_every_node_reads_or_writes_something():
    ends = {end for row in TOPICS for end in row.publishers + row.subscribers}
    assert set(NODES) <= ends


@pytest.mark.parametrize('row', TOPICS, ids=lambda row: row.name)
def test_nothing_that_moves_the_arm_is_queued(row):
    motion = {'segment', 'joint_states', 'external_torque/joint_states', 'current_pose'}
    if row.name in motion or row.name.endswith('/commands'):
        assert profile(row.qos).depth == 1


@pytest.mark.parametrize('row', TOPICS, ids=lambda row: row.name)
def test_what_nodes_tell_each_other_says_who_sent_it(row):
    between_nodes = set(row.publishers) & set(NODES) and set(row.subscribers) & set(NODES)
    assert bool(between_nodes) == (row.ownership is not None)
    if row.ownership is not None:
        mark_carrier(message_type(row.type_name))
        assert 0.0 < row.ownership.hold <= RESTART_S
        moves = row.name == 'segment' or row.name.endswith('/commands')
        assert row.ownership.always == moves


@pytest.mark.parametrize('qos', PROFILES.values(), ids=lambda qos: qos.name)
def test_profiles_say_what_they_do(qos):
    real = profile(qos)
    words = qos.words()
    assert ('best effort' in words) == (real.reliability == ReliabilityPolicy.BEST_EFFORT)
    assert ('transient local' in words) == (real.durability == DurabilityPolicy.TRANSIENT_LOCAL)
    assert f'depth {real.depth}' in words


def test_an_unknown_topic_is_refused_with_the_valid_ones():
    with pytest.raises(UnknownTopicError, match="unknown topic 'segmnt'; valid topics: waypoints"):
        topic('segmnt')
    with pytest.raises(KeyError):
        topic('segmnt')


@pytest.mark.parametrize('name', ['std_msgs/msg/Nothing', 'no_msgs/msg/Bool', 'Bool'])
def test_an_unknown_type_is_refused(name):
    with pytest.raises(MessageError, match='is no message type'):
        message_type(name)


def test_the_markdown_table_has_one_row_per_topic():
    header, rule, *rows = markdown_table().splitlines()
    assert header.count('|') == rule.count('|') == 7
    assert [row.split('`')[1] for row in rows] == [row.name for row in TOPICS]
    assert all(row.count('|') == 7 for row in rows)
