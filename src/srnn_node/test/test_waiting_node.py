# SPDX-License-Identifier: Apache-2.0
"""What a node says while it waits: for a person, or for another node."""

from dataclasses import dataclass
import itertools

import pytest
from rcl_interfaces.msg import Log
from rclpy.parameter import Parameter
from std_msgs.msg import Float64MultiArray

from srnn_config import Parameters, parameter
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_node.lifecycle import WorkspaceNode
from srnn_node.next_step import next_step

COMMANDS = topic('forward_position_controller/commands')
numbers = itertools.count()


@dataclass(frozen=True)
class Needs(Parameters):
    """Parameters of a node that has to be told something."""

    scene: str = parameter(doc='Scene file.')


class Listener(WorkspaceNode):
    """Listens to what another node says, and to what a person may say."""

    def configure(self, parameters):
        self.listen(COMMANDS.name, lambda msg: msg, lambda msg: None)
        self.listen('waypoints', lambda msg: msg, lambda msg: None)


class Needy(Listener):
    """Needs a parameter as well."""

    PARAMETERS = Needs


def make(bench, cls=Listener, **options):
    name = f'node_{next(numbers)}'
    return bench.add(cls(name, context=bench.context, namespace='/left', **options))


def test_a_node_names_the_command_that_brings_it_on(bench):
    node = make(bench)
    full = node.get_fully_qualified_name()
    assert full.startswith('/left/')
    assert next_step(node) == f'unconfigured: waiting for ros2 lifecycle set {full} configure'
    node.trigger_configure()
    assert next_step(node) == f'inactive: waiting for ros2 lifecycle set {full} activate'
    node.trigger_activate()
    assert next_step(node) == ''


def test_a_node_says_what_it_was_not_given(bench):
    assert 'cannot be configured without scene;' in next_step(make(bench, Needy))
    given = [Parameter('scene', value='a.yaml')]
    assert 'configure' in next_step(make(bench, Needy, parameter_overrides=given))


@pytest.fixture
def logged(bench):
    heard = []
    # Given by every node that logs.
    bench.client('reader').create_subscription(Log, '/rosout', heard.append, 100)
    return heard


def test_an_active_node_says_whom_it_misses_and_when_they_are_there(bench, logged):
    node = make(bench)
    words = lambda: [log.msg for log in logged if log.name.endswith(node.get_name())]  # noqa: E731
    node.trigger_configure()
    node.trigger_activate()
    missed = f'nobody publishes /left/{COMMANDS.name} (tracker)'
    bench.spin_until(lambda: missed in words())
    client = bench.client('tracker')
    client.create_publisher(Float64MultiArray, f'/left/{COMMANDS.name}', profile(COMMANDS.qos))
    bench.spin_until(lambda: 'every topic that it listens to has a publisher' in words())
    assert words() == [missed, 'every topic that it listens to has a publisher']


def test_an_inactive_node_misses_nobody(bench, logged):
    idle, active = make(bench), make(bench)
    for node in (idle, active):
        node.trigger_configure()
        node.trigger_activate()
    idle.trigger_deactivate()
    bench.spin_until(lambda: any(log.name.endswith(active.get_name()) for log in logged))
    assert not any(log.name.endswith(idle.get_name()) for log in logged)
