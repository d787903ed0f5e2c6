# SPDX-License-Identifier: Apache-2.0
"""What the graph says is in the bag, all of it, whatever becomes of the recorder."""

from collections.abc import Iterator
import json
import os
from pathlib import Path
import signal
import time

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
import pytest
from rosbags.highlevel import AnyReader
from srnn_process import Srnn
from watched_graph import free_scene, over
import yaml

from srnn_bag import Bag, open_bag
from srnn_bag.attached import PARAMETERS, RUN, SCENE
from srnn_bringup.bag_recorder import RECORDED
from srnn_bringup.config import Configuration
from srnn_bringup.live_graph import LiveGraph
from srnn_msgs_py.topics import ARMS
from srnn_node.signals import StopRequest
from srnn_replay.code_version import code_version

pytestmark = pytest.mark.slow

RUN_S = 5.0
SAFE_NS = 10**9
"""What is older than this is in the bag of a recorder that is killed."""


@pytest.fixture(scope='module')
def configuration(tmp_path_factory: pytest.TempPathFactory) -> Configuration:
    return over('mock', free_scene(tmp_path_factory.mktemp('scene'), velocity=0.1))


@pytest.fixture(scope='module')
def told() -> list[str]:
    return []


@pytest.fixture(scope='module')
def bag(
    configuration: Configuration, told: list[str], tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Bag]:
    """Return the bag of a graph that has run for a while."""
    directory = tmp_path_factory.mktemp('bags') / 'run'
    with (
        StopRequest() as stop,
        LiveGraph(configuration, stop, told.append, bag=directory) as graph,
    ):
        graph.configure()
        graph.activate()
        graph.pump.until(lambda: False, RUN_S)
    return open_bag(directory)


def test_every_topic_is_in_the_bag_with_its_type(bag):
    assert bag.complete
    names = {row.name if row.name.startswith('/') else f'/{row.name}': row for row in RECORDED}
    assert bag.topics == {name: row.type_name for name, row in names.items()}
    heard = {message.topic for message in bag.messages()}
    assert heard >= {
        '/segment', '/executed', '/segment_result', '/weights', '/dissonance', '/current_pose',
        '/joint_states', '/external_torque/joint_states', '/diagnostics',
        '/forward_position_controller/commands', '/markers',
    }  # fmt: skip


def test_what_was_sent_is_what_was_recorded(bag, told):
    """Senders number their messages: from the first on, none is missing."""
    numbers: dict[str, list[int]] = {}
    for message in bag.messages():
        numbers.setdefault(message.topic, []).append(message.sequence)
    for row in RECORDED:
        if (len(row.publishers) == 1 or row.publishers == ARMS) and row.qos.reliable:
            heard = numbers.get(f'/{row.name}', [])
            assert heard == list(range(1, len(heard) + 1)), row.name
    assert len(numbers['/joint_states']) > 200 * RUN_S
    (words,) = [text for text in told if text.startswith('recorded')]
    assert words.startswith(f'recorded {sum(map(len, numbers.values()))} messages in ')
    assert 'LOST' not in words


def test_the_reader_of_rosbags_decodes_every_message(bag):
    with AnyReader([bag.path]) as reader:
        count = 0
        for connection, _, data in reader.messages():
            reader.deserialize(data, connection.msgtype)
            count += 1
    assert count == sum(1 for _ in bag.messages())


def test_the_reader_of_mcap_decodes_every_message(bag):
    (file,) = bag.path.glob('*.mcap')
    with file.open('rb') as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        topics = [one.channel.topic for one in reader.iter_decoded_messages()]
    assert sorted(topics) == sorted(message.topic for message in bag.messages())


def test_all_that_the_run_can_be_repeated_from_is_attached(bag, configuration):
    files = bag.attachments
    run = json.loads(files[RUN])
    assert run['versions'] == code_version()
    assert (run['arm'], run['seed']) == ('mock', configuration.seed)
    assert yaml.safe_load(files[SCENE]) == yaml.safe_load(configuration.scene_path.read_text())
    for node in run['nodes']:
        parameters = yaml.safe_load(files[PARAMETERS.format(node)])['/**']['ros__parameters']
        assert parameters
    planner = yaml.safe_load(files[PARAMETERS.format('planner')])['/**']['ros__parameters']
    assert planner['seed'] == configuration.seed


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Srnn]:
    srnn = Srnn(tmp_path, 'up', '--arm', 'mock')
    try:
        srnn.wait_for('up: ')
        yield srnn
    finally:
        srnn.close()


def test_whoever_joins_a_running_graph_records_it_and_what_it_was_told(graph, tmp_path):
    recorder = Srnn(tmp_path, 'record', 'bag')
    try:
        recorder.wait_for('recording to bag')
        time.sleep(4.0)
        os.kill(recorder.process.pid, signal.SIGINT)
        assert recorder.wait(20.0) == 0
    finally:
        recorder.close()
    assert 'recorded ' in recorder.text
    bag = open_bag(tmp_path / 'bag')
    assert bag.complete
    assert {'/weights', '/markers', '/segment'} <= {m.topic for m in bag.messages()}
    for node in ('mock_arm', 'tracker', 'adapter', 'planner'):
        assert PARAMETERS.format(node) in bag.attachments
    planner = yaml.safe_load(bag.attachments[PARAMETERS.format('planner')])
    scene = Path(planner['/**']['ros__parameters']['scene'])
    assert bag.attachments[SCENE] == scene.read_bytes()


def test_a_killed_recorder_leaves_all_but_the_last_second(graph, tmp_path):
    recorder = Srnn(tmp_path, 'record', 'bag')
    try:
        recorder.wait_for('recording to bag')
        time.sleep(3.0)
        killed = time.time_ns()
        os.kill(recorder.process.pid, signal.SIGKILL)
        recorder.wait(10.0)
    finally:
        recorder.close()
    bag = open_bag(tmp_path / 'bag')
    assert not bag.complete
    stamps = [m.received_ns for m in bag.messages({'/joint_states'})]
    assert stamps[-1] > killed - SAFE_NS
    assert graph.process.poll() is None


def test_a_bag_is_not_written_over(tmp_path):
    (tmp_path / 'bag').mkdir()
    srnn = Srnn(tmp_path, 'up', '--arm', 'mock', '--record', 'bag')
    assert srnn.wait(30.0) == 2
    assert "'bag': is there already; name a new directory" in srnn.text
