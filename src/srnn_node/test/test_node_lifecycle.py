# SPDX-License-Identifier: Apache-2.0
import gc

from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
import pytest
from rclpy.lifecycle import TransitionCallbackReturn
from std_msgs.msg import Float64MultiArray

from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.ros import commands, diagnostics
from srnn_node.lifecycle import WorkspaceNode

COMMANDS = 'forward_position_controller/commands'


class Recorder(WorkspaceNode):
    """Records its hooks; raises where it is told to."""

    def __init__(self, context, breaks_in=()):
        super().__init__('recorder', context=context)
        self.breaks_in = set(breaks_in)
        self.calls = []
        self.heard = []

    def record(self, hook):
        self.calls.append(hook)
        if hook in self.breaks_in:
            raise ValueError(f'no {hook} today')

    def configure(self, parameters):
        self.publisher = self.advertise(COMMANDS)
        self.listen(COMMANDS, lambda msg: commands.from_msg(msg, 1)[0], self.heard.append)
        self.create_timer(100.0, lambda: None)
        self.record('configure')

    def activate(self):
        self.record('activate')

    def deactivate(self):
        self.publisher.publish(Float64MultiArray(data=[-1.0]))
        self.record('deactivate')

    def cleanup(self):
        self.record('cleanup')

    def health(self):
        return Health(HealthLevel.WARN, 'a bit slow', {'ticks': 3})


def ask(bench, client, transition):
    request = ChangeState.Request(transition=Transition(id=transition))
    return bench.call(client, ChangeState, 'recorder/change_state', request).success


def topics_of(node):
    return {s.topic_name for s in node.subscriptions}, {p.topic_name for p in node.publishers}


def test_a_whole_life_by_services(bench):
    node, client = bench.add(Recorder(bench.context)), bench.client()
    born_with = topics_of(node)
    for _ in range(2):
        assert ask(bench, client, Transition.TRANSITION_CONFIGURE)
        assert f'/{COMMANDS}' in topics_of(node)[1]
        assert ask(bench, client, Transition.TRANSITION_ACTIVATE)
        assert (node.state, node.active) == ('active', True)
        assert ask(bench, client, Transition.TRANSITION_DEACTIVATE)
        assert (node.state, node.active) == ('inactive', False)
        assert ask(bench, client, Transition.TRANSITION_CLEANUP)
        assert topics_of(node) == born_with
    assert node.calls == ['configure', 'activate', 'deactivate', 'cleanup'] * 2
    assert ask(bench, client, Transition.TRANSITION_UNCONFIGURED_SHUTDOWN)
    assert node.state == 'finalized'


@pytest.mark.parametrize(
    'transition',
    [
        Transition.TRANSITION_ACTIVATE,
        Transition.TRANSITION_DEACTIVATE,
        Transition.TRANSITION_CLEANUP,
        Transition.TRANSITION_ACTIVE_SHUTDOWN,
        77,
    ],
)
def test_impossible_transitions_are_refused_and_survived(bench, transition):
    node, client = bench.add(Recorder(bench.context)), bench.client()
    assert not ask(bench, client, transition)
    state = bench.call(client, GetState, 'recorder/get_state', GetState.Request())
    assert state.current_state.label == 'unconfigured'
    assert node.calls == []
    assert ask(bench, client, Transition.TRANSITION_CONFIGURE)


def test_a_label_that_nobody_knows_is_refused_and_survived(bench):
    bench.add(Recorder(bench.context))
    client = bench.client()
    request = ChangeState.Request(transition=Transition(label='explode'))
    assert not bench.call(client, ChangeState, 'recorder/change_state', request).success
    assert ask(bench, client, Transition.TRANSITION_CONFIGURE)


def test_shutdown_out_of_action_brings_the_node_to_rest_first(bench):
    node, client = bench.add(Recorder(bench.context)), bench.client()
    assert ask(bench, client, Transition.TRANSITION_CONFIGURE)
    assert ask(bench, client, Transition.TRANSITION_ACTIVATE)
    assert ask(bench, client, Transition.TRANSITION_ACTIVE_SHUTDOWN)
    assert node.calls == ['configure', 'activate', 'deactivate', 'cleanup']
    assert node.state == 'finalized'
    assert gc.isenabled()


def test_nothing_is_published_unless_active(bench):
    node = bench.add(Recorder(bench.context))
    node.trigger_configure()
    bench.spin_until(lambda: node.publisher.get_subscription_count() == 1)
    node.publisher.publish(Float64MultiArray(data=[1.0]))
    node.trigger_activate()
    node.publisher.publish(Float64MultiArray(data=[2.0]))
    bench.spin_until(lambda: node.heard)
    assert node.heard == [2.0]


def test_the_last_message_of_deactivate_goes_out(bench):
    node = bench.add(Recorder(bench.context))
    node.trigger_configure()
    bench.spin_until(lambda: node.publisher.get_subscription_count() == 1)
    node.trigger_activate()
    node.trigger_deactivate()
    bench.spin_until(lambda: node.heard)
    assert node.heard[-1] == -1.0


def test_messages_that_no_converter_takes_are_dropped_and_counted(bench):
    node = bench.add(Recorder(bench.context))
    node.trigger_configure()
    node.trigger_activate()
    bench.spin_until(lambda: node.publisher.get_subscription_count() == 1)
    node.publisher.publish(Float64MultiArray(data=[1.0, 2.0]))
    bench.spin_until(lambda: node.refused_messages == 1)
    node.publisher.publish(Float64MultiArray(data=[3.0]))
    bench.spin_until(lambda: node.heard)
    assert node.heard == [3.0]
    node.trigger_deactivate()


@pytest.mark.parametrize(
    ('hook', 'answers', 'state'),
    [
        ('configure', ['FAILURE'], 'unconfigured'),
        ('activate', ['SUCCESS', 'FAILURE'], 'inactive'),
        ('deactivate', ['SUCCESS', 'SUCCESS', 'ERROR'], 'unconfigured'),
        ('cleanup', ['SUCCESS', 'SUCCESS', 'SUCCESS', 'ERROR'], 'unconfigured'),
    ],
)
def test_a_hook_that_raises_is_told_and_survived(bench, hook, answers, state):
    node = bench.add(Recorder(bench.context, breaks_in=[hook]))
    born_with = topics_of(node)
    triggers = ['configure', 'activate', 'deactivate', 'cleanup'][: len(answers)]
    got = [getattr(node, f'trigger_{name}')() for name in triggers]
    assert got == [getattr(TransitionCallbackReturn, answer) for answer in answers]
    assert node.failure == f'{hook}: no {hook} today'
    assert (node.state, node.active) == (state, False)
    assert gc.isenabled()
    if state == 'unconfigured':
        assert topics_of(node) == born_with
    node.breaks_in.clear()
    if state == 'unconfigured':
        assert node.trigger_configure() == TransitionCallbackReturn.SUCCESS
    assert node.trigger_activate() == TransitionCallbackReturn.SUCCESS
    node.trigger_deactivate()


def test_health_is_told_in_every_state(bench):
    node, client = bench.add(Recorder(bench.context)), bench.client()
    heard = []
    client.create_subscription(DiagnosticArray, '/diagnostics', heard.append, 10)
    bench.spin_until(lambda: heard)
    health = diagnostics.from_msg(heard[-1])['/recorder']
    assert (health.level, health.message) == (HealthLevel.WARN, 'a bit slow')
    assert health.values == {'state': 'unconfigured', 'refused_messages': '0', 'ticks': '3'}
    node.trigger_configure()
    bench.spin_until(lambda: 'inactive' in diagnostics.from_msg(heard[-1])['/recorder'].values[
        'state'
    ])
