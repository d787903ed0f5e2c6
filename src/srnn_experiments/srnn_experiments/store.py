# SPDX-License-Identifier: Apache-2.0
"""Finished trials on disk, one line each, so that a killed run goes on where it stopped."""

from base64 import b64decode, b64encode
import json
import os
from pathlib import Path
from typing import Any
import zlib

import numpy as np

from srnn_experiments.errors import StoreError
from srnn_msgs_py.weights import LearnedWeights

Key = tuple[str, int]
"""Digest of the setting, and seed."""


class TrialStore:
    """A file of JSON lines; every line is on the disk before the next trial counts.

    Without a path it only remembers.
    """

    def __init__(self, path: Path | None = None) -> None:
        """Read what is there; a last line that was cut off by a crash is dropped.

        Raises:
            StoreError: the file is not one of ours.
            OSError: it cannot be read or written.

        """
        self._path = path
        self._done: dict[Key, dict[str, Any]] = {}
        if path is not None and path.exists():
            self._read(path)

    def __contains__(self, key: Key) -> bool:
        return key in self._done

    def __getitem__(self, key: Key) -> dict[str, Any]:
        return self._done[key]

    def add(self, key: Key, trial: dict[str, Any]) -> None:
        """Keep a finished trial."""
        self._done[key] = trial
        if self._path is None:
            return
        line = json.dumps({'setting': key[0], 'seed': key[1], 'trial': trial}, allow_nan=False)
        with self._path.open('a', encoding='utf-8') as file:
            file.write(line + '\n')
            file.flush()
            os.fsync(file.fileno())

    def _read(self, path: Path) -> None:
        text = path.read_text(encoding='utf-8')
        whole, _, rest = text.rpartition('\n')
        for number, line in enumerate(whole.splitlines(), start=1):
            try:
                entry = json.loads(line)
                self._done[entry['setting'], entry['seed']] = entry['trial']
            except (ValueError, KeyError, TypeError) as error:
                raise StoreError(f'{path}, line {number}: not a finished trial') from error
        if rest:
            path.write_text(whole + '\n' if whole else '', encoding='utf-8')


def pack(weights: LearnedWeights) -> str:
    """Return weights as text."""
    parts = (
        np.array([weights.neurons, weights.prior, len(weights.synapses)], dtype='<i8'),
        weights.synapses.astype('<i8'),
        weights.values.astype('<f4'),
    )
    return b64encode(zlib.compress(b''.join(part.tobytes() for part in parts))).decode()


def unpack(text: str) -> LearnedWeights:
    """Return the weights of a text from `pack`."""
    content = zlib.decompress(b64decode(text))
    neurons, prior, count = np.frombuffer(content, dtype='<i8', count=3).tolist()
    synapses = np.frombuffer(content, dtype='<i8', count=count, offset=24)
    values = np.frombuffer(content, dtype='<f4', offset=24 + 8 * count)
    return LearnedWeights(
        neurons, prior, synapses.astype(np.int64), values.astype(np.float32)
    )
