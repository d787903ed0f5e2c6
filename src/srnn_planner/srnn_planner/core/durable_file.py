# SPDX-License-Identifier: Apache-2.0
"""Files that are there whole after a crash, old or new."""

from contextlib import suppress
import os
from pathlib import Path
import tempfile

PREVIOUS = '.previous'
"""Ending of the name under which the file before the newest one is kept."""


def replace(path: Path, content: bytes, keep_previous: bool = False) -> None:
    """Write beside the target, flush to the disk, then take its place in one step.

    Args:
        path: file to write; at every instant it is either as before or as after.
        content: what it shall hold. Once this returns, it is on the disk.
        keep_previous: whether the old file stays as well, as `previous(path)`.

    Raises:
        OSError: the place cannot be written; the old file stays.

    """
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=_prefix(path))
    try:
        with os.fdopen(handle, 'wb') as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        if keep_previous and path.exists():
            _link(path, previous(path), f'{temporary}.old')
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
    directory = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(directory)
    finally:
        os.close(directory)


def previous(path: Path) -> Path:
    """Return where the file before the newest one is kept."""
    return path.with_name(path.name + PREVIOUS)


def remove_leftovers(path: Path) -> None:
    """Remove what writers of `path` that were killed have left beside it."""
    for name in os.listdir(path.parent):
        if name.startswith(_prefix(path)):
            with suppress(OSError):
                (path.parent / name).unlink()


def _prefix(path: Path) -> str:
    return f'.{path.name}.'


def _link(path: Path, name: Path, temporary: str) -> None:
    """Give a file a second name, in one step; not every file system can."""
    try:
        os.link(path, temporary)
        os.replace(temporary, name)
    except OSError:
        Path(temporary).unlink(missing_ok=True)
