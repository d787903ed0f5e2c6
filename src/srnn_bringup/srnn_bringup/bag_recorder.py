# SPDX-License-Identifier: Apache-2.0
"""Records what the graph says, as it was on the wire."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
import json
import operator
from pathlib import Path
import time
from types import TracebackType
from typing import NamedTuple, Self

from rclpy.node import Node
from rclpy.parameter import Parameter

from srnn_bag import Attachment, BagWriter, Message
from srnn_bag.attached import REMAPPED
from srnn_bringup.sequence_gaps import SequenceGaps
from srnn_msgs_py.qos import MOTION, Qos
from srnn_msgs_py.topics import ARMS, TOPICS, Topic
from srnn_node.polling import PolledTopic

POLL_S = 0.05
"""Messages are fetched this often [s]: cheaper by far than one by one."""

FLUSH_S = 0.25
"""What is older than this is safe from the end of this process [s]."""

HISTORY = 2000
"""Messages of one topic that may wait to be fetched: those of several seconds."""

NODE = 'srnn_recorder'

LOG = Topic(
    '/rosout', 'rcl_interfaces/msg/Log', Qos('log', reliable=True, latched=True, depth=HISTORY),
    (), (), 'what the nodes have logged',
)  # fmt: skip
RECORDED = (*TOPICS, LOG)


class _Track(NamedTuple):
    topic: PolledTopic
    gaps: SequenceGaps | None


@dataclass
class BagRecorder:
    """Fetches messages from the middleware and writes them; have `poll` called.

    Its node must not be served by an executor, which would take the messages itself.

    Attributes:
        node: node to listen with; closed with the recorder.
        writer: a new bag; closed with the recorder.

    """

    node: Node
    writer: BagWriter
    _tracks: list[_Track] = field(default_factory=list)
    _waiting: list[Message] = field(default_factory=list)
    _flushed: float = 0.0

    def __post_init__(self) -> None:
        for row in RECORDED:
            self._listen(row)
        remapped = self._remapped()
        if remapped:
            content = json.dumps(remapped, indent=1).encode()
            self.attach([Attachment(REMAPPED, 'application/json', content)])

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def lost(self) -> Mapping[str, int]:
        """Number of messages that were sent and did not arrive, by topic; empty for none."""
        gaps = {track.topic.name: track.gaps.lost for track in self._tracks if track.gaps}
        return {topic: lost for topic, lost in gaps.items() if lost}

    def attach(self, files: Iterable[Attachment]) -> None:
        """Put files into the bag."""
        for file in files:
            self.writer.attach(file.name, file.media_type, file.data, time.time_ns())
        self.writer.flush()

    def poll(self) -> None:
        """Fetch and write what has arrived."""
        fetched_ns = time.time_ns()
        for track in self._tracks:
            self._waiting.extend(_fetch(track))
        self._waiting.sort(key=operator.attrgetter('received_ns'))
        # What came while topics were fetched may be later than what is still to be fetched.
        early = [message for message in self._waiting if message.received_ns < fetched_ns]
        self._waiting = self._waiting[len(early) :]
        self._write(early)

    def words(self) -> str:
        """Return what has become of the recording, for a person."""
        lost = ''.join(f', {count} of {topic} LOST' for topic, count in self.lost.items())
        return f'recorded {self.writer.contents.count} messages in {self.writer.directory}{lost}'

    def close(self) -> None:
        """Fetch what is left and finish the bag."""
        self.poll()
        self._write(self._waiting)
        self._waiting = []
        self.writer.close()
        self.node.destroy_node()

    def _remapped(self) -> dict[str, str]:
        """Return by what name each topic that was remapped is known, by its full name before."""
        full = self.node.resolve_topic_name
        names = {full(row.name, only_expand=True): full(row.name) for row in RECORDED}
        return {name: other for name, other in names.items() if name != other}

    def _listen(self, row: Topic) -> None:
        # Of what is sent hundreds of times a second its sender keeps one message: it could
        # hardly send another again, and to acknowledge each would cost both sides.
        acknowledged = row.qos.reliable and row.qos != MOTION
        qos = replace(row.qos, depth=HISTORY, reliable=acknowledged)
        topic = PolledTopic(self.node, row, qos)
        # The numbers of several senders cannot be told apart.
        one = len(row.publishers) == 1 or row.publishers == ARMS
        gaps = SequenceGaps() if one and row.qos.reliable else None
        self._tracks.append(_Track(topic, gaps))
        self.writer.add_topic(topic.name, row.type_name, row.qos)

    def _write(self, messages: list[Message]) -> None:
        for topic, received_ns, sent_ns, sequence, data in messages:
            self.writer.write(topic, data, received_ns, sent_ns, sequence)
        now = time.monotonic()
        if now - self._flushed > FLUSH_S:
            self._flushed = now
            self.writer.flush()


def record(
    node: Node, directory: Path, remappings: Sequence[tuple[str, str]] = ()
) -> BagRecorder:
    """Begin to record beside a node of this process.

    Args:
        node: the recorder listens in its namespace.
        directory: new directory to record to.
        remappings: names of topics, and what the nodes of the graph use instead.

    Raises:
        BagExistsError: there is something in the place of the bag.

    """
    writer = BagWriter(directory)
    rules = [word for name, other in remappings for word in ('-r', f'{name}:={other}')]
    # It offers no service, which it would need rights for of its own.
    listener = Node(
        NODE, context=node.context, namespace=node.get_namespace(), enable_rosout=False,
        cli_args=['--ros-args', *rules],
        start_parameter_services=False,
        parameter_overrides=[Parameter('start_type_description_service', value=False)],
    )  # fmt: skip
    recorder = BagRecorder(listener, writer)
    node.create_timer(POLL_S, recorder.poll)
    return recorder


def _fetch(track: _Track) -> Iterator[Message]:
    topic, gaps = track
    for data, received_ns, sent_ns, sequence in topic.fetch():
        if gaps is not None:
            gaps.take(sequence)
        yield Message(topic.name, received_ns, sent_ns, sequence, data)
