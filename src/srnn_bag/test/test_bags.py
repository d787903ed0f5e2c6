# SPDX-License-Identifier: Apache-2.0
"""What is written can be read, by us and by others, and what others write by us."""

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
import pytest
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import StoragePlugin, Writer
from sample_bags import ARRAY, POINT, STORE, TOPICS, samples, write

from srnn_bag import BagError, open_bag
from srnn_bag.errors import BagExistsError, BagFormatError, BagMissingError

COUNT = 57


@pytest.fixture(scope='module')
def messages():
    return samples(COUNT)


@pytest.fixture(scope='module')
def directory(messages, tmp_path_factory):
    return write(tmp_path_factory.mktemp('bags') / 'run', messages)


def test_every_message_is_read_as_it_was_written(directory, messages):
    bag = open_bag(directory)
    assert bag.complete
    assert bag.topics == TOPICS
    assert bag.attachments == {'scene.yaml': b'name: sample\n'}
    assert list(bag.messages()) == messages
    assert list(bag.messages()) == messages


@pytest.mark.parametrize('topic', TOPICS)
def test_one_topic_is_read_alone(directory, messages, topic):
    chosen = [message for message in messages if message.topic == topic]
    assert list(open_bag(directory).messages({topic})) == chosen


@pytest.mark.parametrize('flush_every', [1, 10])
@pytest.mark.parametrize('cut', [0, 100])
def test_topics_that_were_heard_are_those_with_messages(tmp_path, messages, flush_every, cut):
    silent, spoken = TOPICS
    for kept in ([spoken], [silent, spoken], []):
        chosen = [message for message in messages if message.topic in kept]
        folder = write(tmp_path / f'run{len(kept)}', chosen, flush_every)
        (file,) = folder.glob('*.mcap')
        file.write_bytes(file.read_bytes()[: file.stat().st_size - cut])
        bag = open_bag(file)
        assert bag.complete == (cut == 0)
        assert bag.heard(TOPICS) == {*kept}
        assert bag.heard({silent}) == {*kept} & {silent}
        for topic in TOPICS:
            assert list(bag.messages({topic})) == [m for m in chosen if m.topic == topic]


def test_the_file_alone_is_a_bag_too(directory, messages):
    (file,) = directory.glob('*.mcap')
    assert list(open_bag(file).messages()) == messages


def test_the_reader_of_rosbags_decodes_all_of_it(directory, messages):
    with AnyReader([directory]) as reader:
        assert {c.topic: c.msgtype for c in reader.connections} == TOPICS
        assert {c.topic: c.msgcount for c in reader.connections} == {
            topic: sum(m.topic == topic for m in messages) for topic in TOPICS
        }
        read = list(reader.messages())
        assert [(c.topic, stamp, bytes(data)) for c, stamp, data in read] == [
            (m.topic, m.received_ns, m.data) for m in messages
        ]
        for connection, _, data in read:
            reader.deserialize(data, connection.msgtype)


def test_the_reader_of_mcap_decodes_all_of_it_from_the_schemas_in_the_bag(directory, messages):
    (file,) = directory.glob('*.mcap')
    with file.open('rb') as stream:
        decoded = list(make_reader(stream, decoder_factories=[DecoderFactory()])
                       .iter_decoded_messages())  # fmt: skip
    assert [d.channel.topic for d in decoded] == [m.topic for m in messages]
    assert [d.message.sequence for d in decoded] == [m.sequence for m in messages]
    for number, one in enumerate(decoded):
        value = one.decoded_message
        if one.schema.name == ARRAY:
            assert list(value.data) == [number + n for n in range(7)]
        else:
            assert (one.schema.name, value.point.x) == (POINT, number)
            assert value.header.frame_id == 'srnn_workspace'


def test_bags_of_another_writer_are_read(tmp_path, messages):
    with Writer(tmp_path / 'other', version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connections = {
            topic: writer.add_connection(topic, type_name, typestore=STORE)
            for topic, type_name in TOPICS.items()
        }
        for message in messages:
            writer.write(connections[message.topic], message.received_ns, message.data)
    bag = open_bag(tmp_path / 'other')
    assert bag.topics == TOPICS
    assert [(m.topic, m.received_ns, m.data) for m in bag.messages()] == [
        (m.topic, m.received_ns, m.data) for m in messages
    ]


def test_no_bag_is_written_over(directory):
    with pytest.raises(BagExistsError, match='is there already'):
        write(directory, [])


def test_an_empty_bag_is_one(tmp_path):
    bag = open_bag(write(tmp_path / 'empty', []))
    assert bag.complete
    assert list(bag.messages()) == []


def sqlite(folder):
    with Writer(folder / 'bag', version=9, storage_plugin=StoragePlugin.SQLITE3):
        pass


def no_metadata(folder):
    (folder / 'bag').mkdir()
    (folder / 'bag/metadata.yaml').write_text('version: 9\n')


def half_gone(folder):
    write(folder / 'bag', samples(3))
    next((folder / 'bag').glob('*.mcap')).unlink()


def no_ros(folder):
    (folder / 'bag').mkdir()
    (folder / 'bag/a.mcap').write_bytes(b'something else entirely')


@pytest.mark.parametrize(
    ('make', 'kind', 'words'),
    [
        (lambda folder: None, BagMissingError, 'there is no such bag'),
        (lambda folder: (folder / 'bag').mkdir(), BagMissingError, 'holds neither'),
        (sqlite, BagFormatError, 'stored as sqlite3'),
        (no_metadata, BagFormatError, 'is not the metadata of a bag'),
        (half_gone, BagMissingError, 'is named in metadata.yaml, and is not there'),
        (no_ros, BagFormatError, 'is damaged, or no MCAP file'),
    ],
)
def test_what_is_no_bag_is_refused_in_one_line(tmp_path, make, kind, words):
    make(tmp_path)
    with pytest.raises(kind, match=words) as caught:
        open_bag(tmp_path / 'bag')
    assert isinstance(caught.value, BagError)
    assert str(tmp_path / 'bag') in str(caught.value)
    assert '\n' not in str(caught.value)
