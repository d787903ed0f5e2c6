# SPDX-License-Identifier: Apache-2.0
"""Weights on disk: written whole or not at all, read as data only."""

from pathlib import Path
from typing import Any

import numpy as np

from srnn_msgs_py.weights import MAX_VERSION, LearnedWeights, WeightsUpdate
from srnn_planner.core import durable_file
from srnn_planner.core.archive import Archive, pack
from srnn_planner.core.errors import WeightsError, WeightsFileError

LATEST = MAX_VERSION // 2
"""Highest version of a file: whoever goes on from it has room for later ones."""


def save(path: str | Path, weights: WeightsUpdate) -> None:
    """Write weights so that a crash leaves either the old file or the new one.

    The file is a NumPy archive with version, segment stamp, what was learned, and a checksum.

    Raises:
        WeightsFileError: the place cannot be written.

    """
    write(Path(path), to_arrays(weights))


def write(path: Path, arrays: dict[str, Any], keep_previous: bool = False) -> None:
    """Write an archive whole or not at all.

    Raises:
        WeightsFileError: the place cannot be written.

    """
    try:
        durable_file.replace(path, pack(**arrays), keep_previous)
    except OSError as error:
        raise WeightsFileError(f'{path}: cannot be written: {error}') from error


def load(path: str | Path) -> WeightsUpdate:
    """Read weights and check them against their checksum.

    Raises:
        WeightsFileError: missing, no regular file, too large or no weight file.
        WeightsError: no weights, or the checksum does not fit the data.

    """
    return from_archive(Archive(path), str(path))


def to_arrays(weights: WeightsUpdate) -> dict[str, Any]:
    """Return weights as the arrays of an archive."""
    return {
        'version': np.int64(weights.version),
        'segment_stamp_ns': np.int64(weights.segment_stamp_ns),
        'neurons': np.int64(weights.learned.neurons),
        'prior': np.int64(weights.learned.prior),
        'synapses': weights.learned.synapses,
        'values': weights.learned.values,
        'checksum': np.uint32(weights.checksum()),
    }


def from_archive(archive: Archive, where: str) -> WeightsUpdate:
    """Return the weights of an archive; see `load` for the errors."""
    weights = WeightsUpdate(
        version=archive.whole('version'),
        segment_stamp_ns=archive.whole('segment_stamp_ns'),
        learned=LearnedWeights(
            neurons=archive.whole('neurons'),
            prior=archive.whole('prior'),
            synapses=archive.array('synapses', np.int64, None),
            values=archive.array('values', np.float32, None),
        ),
    )
    if weights.version > LATEST:
        raise WeightsError(f'{where}: version {weights.version}: must be <= {LATEST}')
    objection = weights.learned.objection()
    if objection:
        raise WeightsError(f'{where}: {objection}')
    expected = int(archive.array('checksum', np.uint32))
    if weights.checksum() != expected:
        raise WeightsError(f'{where}: checksum {expected:#010x} does not fit the data')
    return weights
