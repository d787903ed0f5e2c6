# SPDX-License-Identifier: Apache-2.0
"""Reading a file of bounded size, and nothing that merely looks like one."""

import errno
import os
from pathlib import Path
import stat

from srnn_config.errors import ConfigFileError


def read_regular(path: str | Path, max_bytes: int, follow_links: bool = True) -> bytes:
    """Return the content of a regular file.

    Args:
        path: file to read. Pipes and devices, from which a read may never return, are
            refused without reading.
        max_bytes: longer files are refused before anything is read.
        follow_links: whether the path itself may be a symbolic link.

    Raises:
        ConfigFileError: missing, unreadable, too large, or no regular file.

    """
    flags = os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC
    try:
        handle = os.open(path, flags if follow_links else flags | os.O_NOFOLLOW)
        try:
            content = _content(handle, max_bytes)
        finally:
            os.close(handle)
    # A path with a zero byte is a ValueError.
    except (OSError, ValueError) as error:
        link = isinstance(error, OSError) and error.errno == errno.ELOOP
        what = 'is a symbolic link' if link else f'cannot be read: {error}'
        raise ConfigFileError(f'{path}: {what}') from error
    if isinstance(content, str):
        raise ConfigFileError(f'{path}: {content}')
    return content


def _content(handle: int, max_bytes: int) -> bytes | str:
    """Return the content of an open file, or what is wrong with it."""
    state = os.fstat(handle)
    if not stat.S_ISREG(state.st_mode):
        return 'is no regular file'
    if state.st_size > max_bytes:
        return f'larger than {max_bytes} bytes'
    with os.fdopen(handle, 'rb', closefd=False) as file:
        content = file.read(state.st_size + 1)
    return content if len(content) == state.st_size else 'changed while it was read'
