# SPDX-License-Identifier: Apache-2.0
"""Keys in files that only their owner can read."""

from contextlib import suppress
import os
from pathlib import Path
import re
import stat

from srnn_access.errors import (
    KeyFileClosedError,
    KeyFileError,
    KeyFileExistsError,
    KeyFileMissingError,
)
from srnn_access.key import LENGTH, Key

MODE = 0o600

_TEXT = re.compile(rf'[0-9a-f]{{{2 * LENGTH}}}\n?'.encode())
_OTHERS = 0o077


def create(path: Path) -> Key:
    """Write a new random key as hex digits, readable by its owner alone.

    Raises:
        KeyFileExistsError: there is a file of this name; it is left as it is.
        KeyFileClosedError: the system does not let it be written.

    """
    key = Key.random()
    try:
        number = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, MODE)
        try:
            with os.fdopen(number, 'w', encoding='ascii') as file:
                os.fchmod(number, MODE)
                file.write(key.secret.hex() + '\n')
        except OSError:
            with suppress(OSError):
                os.unlink(path)
            raise
    except FileExistsError:
        raise KeyFileExistsError(
            f'key file {path} exists already: it is never overwritten'
        ) from None
    except OSError as error:
        raise KeyFileClosedError(f'key file {path}: {error.strerror}') from error
    return key


def load(path: Path) -> Key:
    """Return the key of a file.

    Raises:
        KeyFileMissingError: there is no such file.
        KeyFileClosedError: the system does not let it be read.
        KeyFileError: others than its owner may read or write it, or it holds no key.

    """
    try:
        # Without O_NONBLOCK, opening a pipe would wait for its writer.
        number = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        try:
            _check_mode(path, os.fstat(number).st_mode)
            text = os.read(number, 2 * LENGTH + 2)
        finally:
            os.close(number)
    except FileNotFoundError:
        raise KeyFileMissingError(
            f'key file {path}: there is no such file; srnn key create makes one'
        ) from None
    except OSError as error:
        raise KeyFileClosedError(f'key file {path}: {error.strerror}') from error
    if not _TEXT.fullmatch(text):
        raise KeyFileError(
            f'key file {path} holds no key: must be {2 * LENGTH} hex digits in small letters'
        )
    return Key(bytes.fromhex(text.decode('ascii')))


def _check_mode(path: Path, mode: int) -> None:
    if not stat.S_ISREG(mode):
        raise KeyFileError(f'key file {path}: must be a regular file')
    if mode & _OTHERS:
        raise KeyFileError(
            f'key file {path} has mode {stat.S_IMODE(mode):04o}: others than its owner may '
            f'use it; must be {MODE:04o} (chmod 600)'
        )
