# SPDX-License-Identifier: Apache-2.0
"""NumPy archives (.npz), read as arrays of known types and sizes and as nothing else."""

import io
import math
from pathlib import Path
from typing import Any
import zipfile

import numpy as np
from numpy.typing import NDArray

from srnn_config import ConfigFileError
from srnn_config.regular_file import read_regular
from srnn_planner.core.errors import WeightsFileError

MAX_FILE_BYTES = 1 << 28
"""Longest file, and largest array in it once unpacked."""

_MAX_DIRECTORY_BYTES = 1 << 14
_END_OF_ARCHIVE = 22


def pack(**arrays: Any) -> bytes:
    """Return arrays as an archive.

    Raises:
        WeightsFileError: it would be longer than what is read again.

    """
    buffer = io.BytesIO()
    # Not compressed, because an update is on disk before it is shared.
    np.savez(buffer, **arrays)
    content = buffer.getvalue()
    if len(content) > MAX_FILE_BYTES:
        raise WeightsFileError(f'{len(content)} bytes: files have at most {MAX_FILE_BYTES}')
    return content


class Archive:
    """An archive in memory; nothing of it is unpacked before its size is known."""

    def __init__(self, path: str | Path) -> None:
        """Read a file.

        Raises:
            WeightsFileError: missing, no regular file, too large or no archive.

        """
        self._path = path
        try:
            content = read_regular(path, MAX_FILE_BYTES, follow_links=False)
        except ConfigFileError as error:
            raise WeightsFileError(str(error)) from error
        try:
            _require_short_directory(content)
            self._zip = zipfile.ZipFile(io.BytesIO(content))
        except Exception as error:
            raise self._refusal(error) from error

    def array(self, name: str, dtype: Any, *shape: int | None) -> NDArray[Any]:
        """Return an array.

        Args:
            name: its name in the archive.
            dtype: type that it must have.
            shape: size of every dimension, None where any will do.

        Raises:
            WeightsFileError: missing, damaged, or of another type or shape.

        """
        try:
            return self._read(f'{name}.npy', np.dtype(dtype), shape)
        # The parsers of zip and npy files raise almost anything if they are made to.
        except Exception as error:
            raise self._refusal(error, f'{name}: ') from error

    def whole(self, name: str) -> int:
        """Return a whole number >= 0; see `array` for the errors."""
        value = int(self.array(name, np.int64))
        if value < 0:
            raise self._refusal(ValueError(f'{name} = {value}: must be >= 0'))
        return value

    def _read(
        self, member: str, dtype: np.dtype[Any], wanted: tuple[int | None, ...]
    ) -> NDArray[Any]:
        if member not in self._zip.namelist():
            raise ValueError('is missing')
        with self._zip.open(member) as file:
            if np.lib.format.read_magic(file) != (1, 0):
                raise ValueError('unknown version of the array format')
            shape, fortran, found = np.lib.format.read_array_header_1_0(file)
            if found != dtype:
                raise ValueError(f'type {found}: must be {dtype}')
            fits = len(shape) == len(wanted) and all(
                want in (None, size) for size, want in zip(shape, wanted, strict=False)
            )
            if not fits:
                raise ValueError(f'shape {shape}: must be {wanted}, None for any size')
            size = math.prod(shape) * dtype.itemsize
            if size > MAX_FILE_BYTES:
                raise ValueError(f'{size} bytes: must be at most {MAX_FILE_BYTES}')
            # The end has to be reached for the checksum of the archive to be looked at.
            data = file.read(size + 1)
        if len(data) != size:
            raise ValueError(f'{len(data)} bytes or more: must be {size}')
        return np.frombuffer(data, dtype).reshape(shape, order='F' if fortran else 'C').copy()

    def _refusal(self, error: Exception, what: str = '') -> WeightsFileError:
        return WeightsFileError(f'{self._path}: is no weight file: {what}{error or repr(error)}')


def _require_short_directory(content: bytes) -> None:
    """Refuse archives of millions of members; reading their names alone fills the memory."""
    end = content[-_END_OF_ARCHIVE:]
    extended = content[-_END_OF_ARCHIVE - 20 : -_END_OF_ARCHIVE].startswith(b'PK\x06\x07')
    if len(end) < _END_OF_ARCHIVE or not end.startswith(b'PK\x05\x06') or extended:
        raise ValueError('the end is not that of an archive')
    if int.from_bytes(end[12:16], 'little') > _MAX_DIRECTORY_BYTES:
        raise ValueError('too many members')
