# SPDX-License-Identifier: Apache-2.0
"""All that learning needs to go on as if it had never been interrupted, in one file."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.weights import LearnedWeights, WeightsUpdate
from srnn_planner.core import generator_state, weights_file
from srnn_planner.core.archive import Archive
from srnn_planner.core.errors import WeightsError
from srnn_planner.core.history import LENGTH, RECORD
from srnn_planner.core.lineage import KEPT


@dataclass(frozen=True, eq=False)
class Checkpoint:
    """Learning at one moment.

    Attributes:
        weights: the weights in use.
        earlier: the versions before them, oldest first.
        updates: number of updates so far.
        reverts: number of times that dead weights were left.
        generator: (6,) state of the random numbers, see `generator_state`.
        history: (n,) of type `history.RECORD`.

    """

    weights: WeightsUpdate
    earlier: tuple[WeightsUpdate, ...]
    updates: int
    reverts: int
    generator: NDArray[np.uint64]
    history: NDArray[np.void]


def save(path: Path, checkpoint: Checkpoint) -> None:
    """Write a checkpoint so that a crash leaves either the old one or the new one.

    It is a weight file with more in it. The one before stays, see `durable_file.previous`.

    Raises:
        WeightsFileError: the place cannot be written.

    """
    earlier = checkpoint.earlier
    arrays = {
        **weights_file.to_arrays(checkpoint.weights),
        'updates': np.int64(checkpoint.updates),
        'reverts': np.int64(checkpoint.reverts),
        'generator': checkpoint.generator,
        'history': checkpoint.history,
        'earlier': np.array([(w.version, w.segment_stamp_ns) for w in earlier], np.int64)
        .reshape(-1, 2),
        # One by one: a stack of all would have to be copied together first.
        **{f'earlier_{n}_synapses': w.learned.synapses for n, w in enumerate(earlier)},
        **{f'earlier_{n}_values': w.learned.values for n, w in enumerate(earlier)},
    }  # fmt: skip
    weights_file.write(path, arrays, keep_previous=True)


def load(path: Path) -> Checkpoint:
    """Read a checkpoint.

    Raises:
        WeightsFileError: missing, no regular file, too large or no checkpoint.
        WeightsError: the checksum does not fit the data, or numbers are out of range.

    """
    archive = Archive(path)
    weights = weights_file.from_archive(archive, str(path))
    history = archive.array('history', RECORD, None)
    identities = archive.array('earlier', np.int64, None, 2).tolist()
    if len(history) > LENGTH or len(identities) > KEPT:
        raise WeightsError(
            f'{path}: {len(history)} events, {len(identities)} earlier versions: '
            f'must be at most {LENGTH}, {KEPT}'
        )
    versions = [version for version, _ in identities]
    if sorted({*versions, -1, weights.version}) != [-1, *versions, weights.version]:
        raise WeightsError(f'{path}: versions {[*versions, weights.version]}: must increase')
    return Checkpoint(
        weights=weights,
        earlier=tuple(
            WeightsUpdate(version, stamp, _earlier(archive, n, weights.learned))
            for n, (version, stamp) in enumerate(identities)
        ),
        updates=archive.whole('updates'),
        reverts=archive.whole('reverts'),
        generator=archive.array('generator', np.uint64, generator_state.LENGTH),
        history=history,
    )


def _earlier(archive: Archive, n: int, newest: LearnedWeights) -> LearnedWeights:
    return LearnedWeights(
        neurons=newest.neurons,
        prior=newest.prior,
        synapses=archive.array(f'earlier_{n}_synapses', np.int64, None),
        values=archive.array(f'earlier_{n}_values', np.float32, None),
    )
