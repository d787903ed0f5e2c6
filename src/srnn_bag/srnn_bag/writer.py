# SPDX-License-Identifier: Apache-2.0
"""Writes a bag that can be read even if its writer is killed."""

from pathlib import Path
from types import TracebackType
from typing import Self

from mcap.writer import CompressionType, Writer
import yaml

from srnn_bag import metadata
from srnn_bag.definitions import definition
from srnn_bag.errors import BagExistsError
from srnn_bag.metadata import Contents, Track
from srnn_msgs_py.qos import Qos

LIBRARY = 'srnn_bag'
PROFILE = 'ros2'
SCHEMA_ENCODING = 'ros2msg'


class BagWriter:
    """A new bag: a directory with one MCAP file, and its metadata once it is closed.

    What was written before the last `flush` is in the hands of the operating system: the end
    of this process, whatever its reason, loses none of it.

    Attributes:
        directory: where the bag is.
        contents: what is in it so far.

    """

    def __init__(self, directory: Path) -> None:
        """Begin a bag.

        Raises:
            BagExistsError: there is something in its place.

        """
        self.directory = directory
        name = f'{directory.name}_0.mcap'
        self.contents = Contents(name)
        try:
            directory.mkdir(parents=True)
        except FileExistsError:
            raise BagExistsError(
                f'{directory}: is there already; name a new directory for the bag'
            ) from None
        self._stream = (directory / name).open('wb')
        self._writer = Writer(self._stream, compression=CompressionType.ZSTD)
        self._writer.start(profile=PROFILE, library=LIBRARY)
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def attach(self, name: str, media_type: str, data: bytes, created_ns: int) -> None:
        """Keep a file that is no message."""
        self._writer.add_attachment(created_ns, created_ns, name, media_type, data)

    def add_topic(self, topic: str, type_name: str, qos: Qos) -> None:
        """Make room for the messages of a topic.

        Raises:
            UnknownTypeError: no installed package has the type.

        """
        known = definition(type_name)
        if type_name not in self._schemas:
            self._schemas[type_name] = self._writer.register_schema(
                type_name, SCHEMA_ENCODING, known.text.encode()
            )
        profiles = {'offered_qos_profiles': yaml.safe_dump([metadata.offered(qos)])}
        self._channels[topic] = self._writer.register_channel(
            topic, metadata.ENCODING, self._schemas[type_name], profiles
        )
        self.contents.tracks[topic] = Track(topic, known, qos)

    def write(
        self, topic: str, data: bytes, received_ns: int, sent_ns: int, sequence: int
    ) -> None:
        """Add a message.

        Args:
            topic: a topic that was added.
            data: the message as it was on the wire, in CDR.
            received_ns: when it arrived [ns of system time].
            sent_ns: when it was sent [ns of system time].
            sequence: its number among those of its sender.

        """
        self._writer.add_message(self._channels[topic], received_ns, data, sent_ns, sequence)
        self.contents.tracks[topic].count += 1
        self.contents.span.extend(received_ns)

    def flush(self) -> None:
        """Hand over what was written to the operating system."""
        self._writer.flush()

    def close(self) -> None:
        """Finish the bag; twice is once."""
        if self._stream.closed:
            return
        information = self.contents.information()
        self._writer.add_metadata('rosbag2', {'serialized_metadata': metadata.text(information)})
        self._writer.finish()
        self._stream.close()
        file = self.directory / metadata.FILE
        file.write_text(metadata.text({metadata.KEY: information}), encoding='utf-8')
