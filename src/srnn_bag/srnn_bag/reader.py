# SPDX-License-Identifier: Apache-2.0
"""Reads bags: our own, those of `ros2 bag record`, and what a killed recorder has left."""

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
import re
from typing import Any

import yaml

from srnn_bag import metadata
from srnn_bag.errors import BagFormatError, BagMissingError
from srnn_bag.mcap_file import McapFile, Message

SUFFIX = '.mcap'


@dataclass(frozen=True)
class Bag:
    """A bag that can be read more than once.

    Attributes:
        path: what was opened.
        files: its MCAP files, in order.

    """

    path: Path
    files: tuple[McapFile, ...]

    @property
    def complete(self) -> bool:
        """Tell whether its recorder has come to an orderly end."""
        return all(file.complete for file in self.files)

    @property
    def topics(self) -> dict[str, str]:
        """Type name of every topic."""
        return {topic: name for file in self.files for topic, name in file.topics.items()}

    @property
    def attachments(self) -> dict[str, bytes]:
        """Content of the attached files, by name."""
        return {name: data for file in self.files for name, data in file.attachments.items()}

    def messages(self, topics: Collection[str] | None = None) -> Iterator[Message]:
        """Return the messages of some topics, of all if None, in the order of the files.

        Raises:
            BagFormatError: a part of the bag is damaged.

        """
        return chain.from_iterable(file.messages(topics) for file in self.files)

    def heard(self, topics: Collection[str]) -> set[str]:
        """Return which of some topics have messages.

        Raises:
            BagFormatError: a part of the bag is damaged.

        """
        return {topic for file in self.files for topic in file.heard(topics)}


def open_bag(path: Path) -> Bag:
    """Open a bag: its directory, or one MCAP file of it.

    Raises:
        BagMissingError: there is none.
        BagFormatError: it is damaged, or of a storage that is not MCAP.

    """
    if path.is_dir():
        names = _names(path)
    elif path.is_file():
        names = [path]
    else:
        raise BagMissingError(f'{path}: there is no such bag')
    return Bag(path, tuple(McapFile(name) for name in names))


def _names(directory: Path) -> list[Path]:
    """Return the files of a bag, as its metadata say if it has any."""
    information = _information(directory / metadata.FILE)
    if information is None:
        names = sorted(directory.glob(f'*{SUFFIX}'), key=_natural)
        if not names:
            raise BagMissingError(f'{directory}: holds neither {metadata.FILE} nor *{SUFFIX}')
        return names
    storage = information.get('storage_identifier')
    if storage != metadata.STORAGE or information.get('compression_mode'):
        kind = f'{storage}, {information.get("compression_format") or "not compressed"}'
        raise BagFormatError(
            f'{directory}: is stored as {kind}; only MCAP files are read: `ros2 bag convert`'
        )
    names = [directory / Path(str(name)).name for name in information['relative_file_paths']]
    for name in names:
        if not name.is_file():
            raise BagMissingError(f'{name}: is named in {metadata.FILE}, and is not there')
    return names


def _information(file: Path) -> dict[str, Any] | None:
    if not file.is_file():
        return None
    try:
        information = yaml.safe_load(file.read_text(encoding='utf-8'))[metadata.KEY]
        if not isinstance(information['relative_file_paths'], list):
            raise TypeError
        return dict(information)
    except (KeyError, TypeError, ValueError, yaml.YAMLError):
        raise BagFormatError(f'{file}: is not the metadata of a bag') from None


def _natural(path: Path) -> tuple[int, str]:
    """Order files as rosbag2 numbers them: NAME_2 comes before NAME_10."""
    number = re.search(r'_(\d+)$', path.stem)
    return (int(number[1]) if number else 0, path.name)
