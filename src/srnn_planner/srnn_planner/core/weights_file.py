# SPDX-License-Identifier: Apache-2.0
"""Weights on disk: written whole or not at all, read as data only."""

import io
import os
from pathlib import Path
import tempfile
import zipfile

import numpy as np

from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core.errors import WeightsError, WeightsFileError

MAX_FILE_BYTES = 1 << 30


def save(path: str | Path, weights: WeightsUpdate) -> None:
    """Write weights so that a crash leaves either the old file or the new one.

    The file is a NumPy archive with version, segment stamp, matrix and checksum.

    Raises:
        WeightsFileError: the place cannot be written.

    """
    path = Path(path)
    buffer = io.BytesIO()
    # Not compressed, because an update is on disk before it is shared.
    np.savez(
        buffer,
        version=np.int64(weights.version),
        segment_stamp_ns=np.int64(weights.segment_stamp_ns),
        matrix=weights.matrix,
        checksum=np.uint32(weights.checksum()),
    )
    try:
        _replace(path, buffer.getvalue())
    except OSError as error:
        raise WeightsFileError(f'{path}: cannot be written: {error}') from error


def load(path: str | Path) -> WeightsUpdate:
    """Read weights and check them against their checksum.

    Raises:
        WeightsFileError: missing, too large or no weight file.
        WeightsError: the checksum does not fit the data.

    """
    path = Path(path)
    try:
        if path.stat().st_size > MAX_FILE_BYTES:
            raise WeightsFileError(f'{path}: larger than {MAX_FILE_BYTES} bytes')
        with np.load(path, allow_pickle=False) as data:
            weights = WeightsUpdate(
                version=int(data['version']),
                segment_stamp_ns=int(data['segment_stamp_ns']),
                matrix=np.asarray(data['matrix'], dtype=np.float32),
            )
            expected = int(data['checksum'])
    except WeightsFileError:
        raise
    except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
        raise WeightsFileError(f'{path}: is no weight file: {error}') from error
    if weights.checksum() != expected:
        raise WeightsError(f'{path}: checksum {expected:#010x} does not fit the data')
    return weights


def _replace(path: Path, content: bytes) -> None:
    """Write beside the target, flush to the disk, then take its place in one step."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f'.{path.name}.')
    try:
        with os.fdopen(handle, 'wb') as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
    directory = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(directory)
    finally:
        os.close(directory)
