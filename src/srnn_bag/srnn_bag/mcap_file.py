# SPDX-License-Identifier: Apache-2.0
"""One MCAP file, finished or not.

The container is read by the library `mcap`; the messages in its chunks are picked here, many
times faster, because a replay has to read far more of them than it acts on.
"""

from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
import struct
from typing import NamedTuple
import zlib

import lz4.frame
from mcap.data_stream import ReadDataStream
from mcap.exceptions import EndOfFile
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Attachment, Channel, Chunk, ChunkIndex, Schema
from mcap.records import Message as McapMessage
from mcap.stream_reader import StreamReader
import zstandard

from srnn_bag.errors import BagFormatError

PROFILE = 'ros2'

LARGEST = 1 << 30
"""No record or chunk is read beyond this size."""

_RECORD = struct.Struct('<BQ')
_MESSAGE = struct.Struct('<HIQQ')
_OPENING = 1 + 8
"""Bytes of opcode and length before the content of a record."""

_TOO_LONG = 'a record goes beyond its chunk'
_MESSAGE_OPCODE = int(Opcode.MESSAGE)
_KINDS = {int(Opcode.SCHEMA): Schema, int(Opcode.CHANNEL): Channel}


class Message(NamedTuple):
    """A message as it was on the wire.

    Attributes:
        topic: full name of the topic.
        received_ns: when the recorder got it [ns of system time].
        sent_ns: when it was sent [ns of system time].
        sequence: its number among those of its sender.
        data: the message in CDR.

    """

    topic: str
    received_ns: int
    sent_ns: int
    sequence: int
    data: bytes


class McapFile:
    """An MCAP file of ROS 2 messages.

    Attributes:
        path: where it is.
        complete: whoever wrote it has finished it.
        topics: type name of every topic.
        attachments: content of the attached files, by name.

    """

    def __init__(self, path: Path) -> None:
        """Look what is in a file.

        Raises:
            BagFormatError: it is no MCAP file of ROS 2 messages, or damaged.

        """
        self.path = path
        self.topics: dict[str, str] = {}
        self.attachments: dict[str, bytes] = {}
        self._types: dict[int, str] = {}
        self._names: dict[int, str] = {}
        self._chunks: tuple[ChunkIndex, ...] = ()
        with self._reading():
            self.complete = self._summary()
            if not self._chunks:
                self._survey()

    def messages(self, topics: Collection[str] | None = None) -> Iterator[Message]:
        """Return the messages of some topics, of all if None, in the order of the file.

        Raises:
            BagFormatError: a part of the file is damaged.

        """
        wanted = {
            number: name for number, name in self._names.items()
            if topics is None or name in topics
        }  # fmt: skip
        with self._reading():
            for record in self._chunks_with(wanted) if self._chunks else self._scan():
                if isinstance(record, Chunk):
                    yield from _messages(self._unpack(record), wanted)
                elif record.channel_id in wanted:
                    yield Message(
                        wanted[record.channel_id], record.log_time, record.publish_time,
                        record.sequence, record.data,
                    )  # fmt: skip

    def heard(self, topics: Collection[str]) -> set[str]:
        """Return which of some topics have messages.

        Raises:
            BagFormatError: a part of the file is damaged.

        """
        if self._chunks and all(chunk.message_index_offsets for chunk in self._chunks):
            numbers = {n for chunk in self._chunks for n in chunk.message_index_offsets}
            return {name for n, name in self._names.items() if n in numbers and name in topics}
        return {message.topic for message in self.messages(topics)}

    def _summary(self) -> bool:
        """Learn from the end of the file what is in it; False if it has no end."""
        with self.path.open('rb') as stream:
            reader = SeekingReader(stream, record_size_limit=LARGEST)
            if reader.get_header().profile != PROFILE:
                raise BagFormatError(f'{self.path}: holds no messages of ROS 2')
            try:
                summary = reader.get_summary()
            except Exception:
                return False  # The end is damaged: what comes before it may be whole.
            if summary is None:
                return False
            for record in (*summary.schemas.values(), *summary.channels.values()):
                self._add(record)
            for attachment in reader.iter_attachments():
                self._add(attachment)
            self._chunks = tuple(
                sorted(summary.chunk_indexes, key=lambda index: index.chunk_start_offset)
            )
            return True

    def _chunks_with(self, channels: Collection[int]) -> Iterator[Chunk]:
        """Return the chunks that may have messages of some channels."""
        with self.path.open('rb') as stream:
            for index in self._chunks:
                # Not every writer says what is in its chunks.
                held = index.message_index_offsets.keys()
                if held and held.isdisjoint(channels):
                    continue
                stream.seek(index.chunk_start_offset + _OPENING)
                yield Chunk.read(ReadDataStream(stream))

    def _survey(self) -> None:
        """Learn what is in a file without an index by going through it."""
        for record in self._scan():
            if isinstance(record, Chunk):
                data = self._unpack(record)
                for opcode, start, _ in _records(data):
                    if opcode in _KINDS:
                        self._add(_KINDS[opcode].read(ReadDataStream(BytesIO(data[start:]))))

    def _scan(self) -> Iterator[Chunk | McapMessage]:
        """Go through a file from its beginning to where its writer stopped."""
        with self.path.open('rb') as stream:
            reader = StreamReader(stream, emit_chunks=True, record_size_limit=LARGEST)
            try:
                for record in reader.records:
                    if isinstance(record, Chunk | McapMessage):
                        yield record
                    else:
                        self._add(record)
            except (EndOfFile, struct.error):
                return

    def _unpack(self, chunk: Chunk) -> bytes:
        if chunk.uncompressed_size > LARGEST:
            raise BagFormatError(f'{self.path}: a chunk of {chunk.uncompressed_size} bytes')
        match chunk.compression:
            case 'zstd':
                data = zstandard.decompress(chunk.data, chunk.uncompressed_size)
            case 'lz4':
                data = lz4.frame.decompress(chunk.data)
            case '':
                data = chunk.data
            case other:
                raise BagFormatError(f'{self.path}: a chunk is packed by {other!r}')
        if chunk.uncompressed_crc and zlib.crc32(data) != chunk.uncompressed_crc:
            raise BagFormatError(f'{self.path}: a chunk has a bad checksum')
        return bytes(data)

    def _add(self, record: object) -> None:
        if isinstance(record, Schema):
            self._types[record.id] = record.name
        elif isinstance(record, Channel):
            self._names[record.id] = record.topic
            self.topics[record.topic] = self._types.get(record.schema_id, '')
        elif isinstance(record, Attachment):
            self.attachments[record.name] = record.data

    @contextmanager
    def _reading(self) -> Iterator[None]:
        """Say of which file an error is, in one line."""
        try:
            yield
        except BagFormatError:
            raise
        except Exception as error:
            # What the library runs into on damaged data is not for it to foresee.
            words = f'{type(error).__name__}: {error}'.splitlines()[0]
            raise BagFormatError(f'{self.path}: is damaged, or no MCAP file ({words})') from error


def _records(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Return opcode, start and end of the content of every record in an unpacked chunk."""
    position = 0
    while position < len(data):
        opcode, length = _RECORD.unpack_from(data, position)
        start = position + _OPENING
        position = start + length
        if position > len(data):
            raise ValueError(_TOO_LONG)
        yield opcode, start, position


def _messages(data: bytes, wanted: Mapping[int, str]) -> list[Message]:
    # Hundreds of thousands go through here: one call for each of them is one too many.
    found: list[Message] = []
    position, size = 0, len(data)
    opening, head, begin = _RECORD.unpack_from, _MESSAGE.unpack_from, _OPENING + _MESSAGE.size
    add, new, topic_of = found.append, tuple.__new__, wanted.get
    while position < size:
        opcode, length = opening(data, position)
        start = position
        position += _OPENING + length
        if position > size:
            raise ValueError(_TOO_LONG)
        if opcode == _MESSAGE_OPCODE:
            channel, sequence, received_ns, sent_ns = head(data, start + _OPENING)
            topic = topic_of(channel)
            if topic is not None:
                content = data[start + begin : position]
                add(new(Message, (topic, received_ns, sent_ns, sequence, content)))
    return found
