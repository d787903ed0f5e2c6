# SPDX-License-Identifier: Apache-2.0
"""Keys and senders as nodes know them, over the real middleware."""

import numpy as np
import pytest
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.parameter import Parameter
from sample_messages import sample_message
from std_msgs.msg import Float32MultiArray

from srnn_access import key_file
from srnn_msgs_py.health import Health, HealthLevel
from srnn_msgs_py.ros import commands, weights
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_node.access import RECENT_S
from srnn_node.lifecycle import WorkspaceNode

COMMANDS = 'forward_position_controller/commands'
SUCCESS, FAILURE = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE


class Mouth(WorkspaceNode):
    """Sends commands and weights."""

    def configure(self, parameters):
        self.commands, self.weights = self.advertise(COMMANDS), self.advertise('weights')

    def say(self, number):
        self.commands.publish(commands.to_msg(np.array([number])))

    def share(self, version):
        learned = LearnedWeights(3, 1, np.arange(4), np.ones(4, dtype=np.float32))
        self.weights.publish(weights.to_msg(WeightsUpdate(version, 0, learned)))


class Ear(WorkspaceNode):
    """Hears commands and weights."""

    def __init__(self, *args, **options):
        super().__init__(*args, **options)
        self.heard, self.versions, self.foreign = [], [], []

    def configure(self, parameters):
        self.listen(
            COMMANDS, lambda msg: float(commands.from_msg(msg, 1)[0]), self.heard.append,
            self.foreign.append,
        )
        self.listen('weights', lambda msg: weights.from_msg(msg).version, self.versions.append)

    def health(self):
        return Health(values={'ticks': 3})


@pytest.fixture
def key(tmp_path):
    key_file.create(tmp_path / 'graph.key')
    return tmp_path / 'graph.key'


@pytest.fixture
def make(bench):
    def node(kind, name, key=''):
        given = [Parameter('key_file', value=str(key))]
        made = bench.add(kind(name, context=bench.context, parameter_overrides=given))
        assert made.trigger_configure() == SUCCESS, made.failure
        made.trigger_activate()
        return made

    return node


def connected(mouth, count=1):
    return lambda: mouth.commands.get_subscription_count() == count


def refusals(node):
    return {k: v for k, v in node._health().values.items() if k.startswith('access_')}


def test_nodes_with_the_same_key_understand_each_other(bench, make, key):
    mouth, ear = make(Mouth, 'mouth', key), make(Ear, 'ear', key)
    bench.spin_until(connected(mouth))
    mouth.say(1.0)
    bench.spin_until(lambda: ear.heard == [1.0])
    assert refusals(ear) == {}
    assert ear._health().values['key'] == key_file.load(key).fingerprint


@pytest.mark.parametrize(('keyed', 'reason'), [(False, 'unsigned'), (True, 'altered')])
def test_whoever_has_no_key_or_another_is_not_heard(bench, make, key, tmp_path, keyed, reason):
    if keyed:
        key_file.create(tmp_path / 'other.key')
    mouth = make(Mouth, 'mouth', tmp_path / 'other.key' if keyed else '')
    ear = make(Ear, 'ear', key)
    bench.spin_until(connected(mouth))
    mouth.say(1.0)
    bench.spin_until(lambda: refusals(ear) == {f'access_{reason}': 1})
    assert (ear.heard, ear.foreign, ear.refused_messages) == ([], [], 0)


def test_health_warns_while_messages_are_refused(bench, make, key, monkeypatch):
    mouth, ear = make(Mouth, 'mouth'), make(Ear, 'ear', key)
    assert ear._health().level == HealthLevel.OK
    bench.spin_until(connected(mouth))
    mouth.say(1.0)
    bench.spin_until(lambda: refusals(ear))
    told = ear._health()
    assert (told.level, told.message) == (HealthLevel.WARN, f'refused: {COMMANDS} carries no code')
    assert told.values['ticks'] == 3
    last = ear._access._inlets[COMMANDS].last_time
    monkeypatch.setattr('time.monotonic', lambda: last + RECENT_S + 0.1)
    told = ear._health()
    assert (told.level, told.message) == (HealthLevel.OK, 'active')
    assert told.values['access_unsigned'] == 1


def test_without_a_key_the_first_sender_keeps_the_topic(bench, make):
    first, ear = make(Mouth, 'first'), make(Ear, 'ear')
    bench.spin_until(connected(first))
    first.say(1.0)
    bench.spin_until(lambda: ear.heard == [1.0])
    second = make(Mouth, 'second')
    bench.spin_until(connected(second))
    first.say(2.0)
    bench.spin_until(lambda: 2.0 in ear.heard)
    second.say(9.0)
    bench.spin_until(lambda: ear.foreign)
    assert (ear.heard, ear.foreign) == ([1.0, 2.0], [9.0])
    assert refusals(ear) == {'access_not_owner': 1}

    def taken_over():
        second.say(3.0)
        bench.executor.spin_once(timeout_sec=0.05)
        return 3.0 in ear.heard

    bench.spin_until(taken_over)
    first.say(4.0)
    bench.spin_until(lambda: 'access_replayed' in refusals(ear))
    assert 4.0 not in ear.heard + ear.foreign


def test_commands_of_people_without_a_mark_are_heard_without_a_key(bench, make):
    ear, row = make(Ear, 'ear'), topic(COMMANDS)
    publisher = bench.client('person').create_publisher(
        message_type(row.type_name), row.name, profile(row.qos)
    )
    bench.spin_until(lambda: publisher.get_subscription_count() == 1)
    for number in (1.0, 2.0):
        publisher.publish(commands.to_msg(np.array([number])))
        bench.spin_until(lambda number=number: number in ear.heard)


def test_a_late_listener_gets_latched_messages_signed_anew(bench, make, key, monkeypatch):
    mouth = make(Mouth, 'mouth', key)
    monkeypatch.setattr('time.time_ns', lambda: 10**18)
    mouth.share(1)
    mouth.share(2)
    monkeypatch.undo()
    ear = make(Ear, 'ear', key)
    bench.spin_until(lambda: ear.versions == [2])
    late = make(Ear, 'late', key)
    bench.spin_until(lambda: late.versions == [2])


def test_without_a_key_latched_messages_are_sent_once(bench, make):
    mouth, raw = make(Mouth, 'mouth'), []
    mouth.share(1)
    row = topic('weights')
    bench.client('tool').create_subscription(
        Float32MultiArray, row.name, raw.append, profile(row.qos)
    )
    ear = make(Ear, 'ear')
    bench.spin_until(lambda: ear.versions and raw)
    ear.listen(COMMANDS, lambda msg: msg, lambda _: None)
    bench.spin_until(connected(mouth, 2))
    assert (ear.versions, len(raw)) == ([1], 1)
    assert weights.from_msg(raw[0]).version == 1


def test_a_silent_publisher_counts_nothing(bench, make, key):
    mouth, ear = make(Mouth, 'mouth', key), make(Ear, 'ear', key)
    mouth.trigger_deactivate()
    bench.spin_until(connected(mouth))
    mouth.say(1.0)
    mouth.trigger_activate()
    mouth.say(2.0)
    bench.spin_until(lambda: ear.heard == [2.0])
    assert mouth.commands._outlet._sequence == 1


@pytest.mark.parametrize('fault', ['missing', 'open to others', 'empty'])
def test_a_node_without_a_good_key_file_refuses_to_be_configured(bench, key, tmp_path, fault):
    if fault == 'missing':
        key = tmp_path / 'nowhere.key'
    elif fault == 'open to others':
        key.chmod(0o644)
    else:
        key.write_text('')
    given = [Parameter('key_file', value=str(key))]
    node = bench.add(Ear('ear', context=bench.context, parameter_overrides=given))
    assert node.trigger_configure() == FAILURE
    assert node.failure.startswith(f'configure: key file {key}')


def test_nobody_can_take_the_key_from_a_running_node(bench, make, key):
    ear = make(Ear, 'ear', key)
    (answer,) = ear.set_parameters([Parameter('key_file', value='')])
    assert not answer.successful
    assert ear.get_parameter('key_file').value == str(key)


def test_a_message_of_every_sealed_topic_reaches_its_listener(bench, make, key):
    class All(WorkspaceNode):
        def configure(self, parameters):
            self.heard = []
            self.out = {name: self.advertise(name) for name in NAMES}
            for name in NAMES:
                self.listen(name, lambda msg, name=name: (name, msg), self.heard.append)

    node = make(All, 'all', key)
    bench.spin_until(lambda: all(p.get_subscription_count() for p in node.out.values()))
    for name, publisher in node.out.items():
        msg = sample_message(name)
        publisher.publish(msg)
        assert msg == sample_message(name)
    bench.spin_until(lambda: len(node.heard) == len(NAMES))
    assert all(msg == sample_message(name) for name, msg in node.heard)


NAMES = (
    'segment', 'executed', 'segment_result', 'weights', 'dissonance', 'current_pose',
    'joint_states', 'external_torque/joint_states', COMMANDS,
)  # fmt: skip
