# SPDX-License-Identifier: Apache-2.0
"""The metadata.yaml of a bag, as rosbag2 of ROS 2 Jazzy writes it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import yaml

from srnn_bag.definitions import Definition
from srnn_msgs_py.qos import Qos

FILE = 'metadata.yaml'
STORAGE = 'mcap'
ENCODING = 'cdr'
KEY = 'rosbag2_bagfile_information'

VERSION = 9
"""Of the layout; Jazzy writes and reads this one."""

DISTRO = 'jazzy'

_NEVER = {'sec': 9223372036, 'nsec': 854775807}


@dataclass
class Track:
    """One topic of a bag, and how many messages it has so far."""

    topic: str
    definition: Definition
    qos: Qos
    count: int = 0


@dataclass
class Span:
    """The time that a bag covers [ns]."""

    first: int | None = None
    last: int = 0

    def extend(self, received_ns: int) -> None:
        """Take in a message."""
        if self.first is None or received_ns < self.first:
            self.first = received_ns
        self.last = max(self.last, received_ns)

    @property
    def start(self) -> dict[str, int]:
        """When the first message came."""
        return {'nanoseconds_since_epoch': self.first or 0}

    @property
    def duration(self) -> dict[str, int]:
        """How long after that the last message came."""
        return {'nanoseconds': self.last - (self.first or 0)}


@dataclass
class Contents:
    """What is in a bag of one file."""

    file: str
    tracks: dict[str, Track] = field(default_factory=dict)
    span: Span = field(default_factory=Span)

    @property
    def count(self) -> int:
        """Number of all messages."""
        return sum(track.count for track in self.tracks.values())

    def information(self) -> dict[str, Any]:
        """Return the metadata, without the key around it."""
        return {
            'version': VERSION,
            'storage_identifier': STORAGE,
            'duration': self.span.duration,
            'starting_time': self.span.start,
            'message_count': self.count,
            'topics_with_message_count': [_topic(track) for track in self.tracks.values()],
            'compression_format': '',
            'compression_mode': '',
            'relative_file_paths': [self.file],
            'files': [
                {
                    'path': self.file,
                    'starting_time': self.span.start,
                    'duration': self.span.duration,
                    'message_count': self.count,
                }
            ],
            'custom_data': None,
            'ros_distro': DISTRO,
        }


def text(information: Mapping[str, Any]) -> str:
    """Return metadata as YAML."""
    return str(yaml.safe_dump(dict(information), sort_keys=False, allow_unicode=True))


def offered(qos: Qos) -> dict[str, Any]:
    """Return a quality of service in the words of rosbag2."""
    return {
        'history': 'keep_last',
        'depth': qos.depth,
        'reliability': 'reliable' if qos.reliable else 'best_effort',
        'durability': 'transient_local' if qos.latched else 'volatile',
        'deadline': dict(_NEVER),
        'lifespan': dict(_NEVER),
        'liveliness': 'automatic',
        'liveliness_lease_duration': dict(_NEVER),
        'avoid_ros_namespace_conventions': False,
    }


def _topic(track: Track) -> dict[str, Any]:
    return {
        'topic_metadata': {
            'name': track.topic,
            'type': track.definition.type_name,
            'serialization_format': ENCODING,
            'offered_qos_profiles': [offered(track.qos)],
            'type_description_hash': track.definition.digest,
        },
        'message_count': track.count,
    }
