# SPDX-License-Identifier: Apache-2.0
"""Keeps checkpoints in a place, and gets over a broken one."""

from collections.abc import Callable
from contextlib import suppress
from itertools import count
import os
from pathlib import Path

from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import checkpoint, durable_file, weights_file
from srnn_planner.core.checkpoint import Checkpoint
from srnn_planner.core.errors import SrnnError, WeightsFileError

BROKEN = '.broken'
"""Ending of the names under which files are kept that cannot be gone on from."""

REFUSED = '.refused'
"""Ending of the name under which the weights that were left last are kept, as a weight file."""


class CheckpointKeeper:
    """Writes and restores the checkpoints of one adapter.

    Attributes:
        version: version of the weights in the newest good checkpoint, None for none.
        unsaved: why the last checkpoint could not be written, empty if it was.
        broken: what was wrong with the files found at the start, empty for nothing.

    """

    def __init__(self, path: str) -> None:
        """Use a place; an empty path keeps nothing.

        Raises:
            WeightsFileError: the place cannot be that of a checkpoint: no directory to hold
                it, or something there that is no regular file.

        """
        self.version: int | None = None
        self.unsaved = self.broken = ''
        self._path = Path(path) if path else None
        if self._path is None:
            return
        if not self._path.parent.is_dir():
            raise WeightsFileError(f'checkpoint = {path}: there is no directory to hold it')
        for place in (self._path, durable_file.previous(self._path)):
            if os.path.lexists(place) and (place.is_symlink() or not place.is_file()):
                raise WeightsFileError(f'checkpoint: {place} is no regular file')
        with suppress(OSError):
            durable_file.remove_leftovers(self._path)

    def keep(self, value: Checkpoint) -> None:
        """Write a checkpoint; where that fails, `unsaved` tells why, and nothing else happens."""
        if self._path is None:
            return
        try:
            checkpoint.save(self._path, value)
        except SrnnError as error:
            self.unsaved = str(error)
            return
        self.unsaved, self.version = '', value.weights.version

    def keep_refused(self, weights: WeightsUpdate) -> None:
        """Write weights that were left beside the checkpoint; see `keep` for what may fail."""
        if self._path is None:
            return
        try:
            weights_file.save(self._path.with_name(self._path.name + REFUSED), weights)
        except SrnnError as error:
            self.unsaved = str(error)

    def restore(self, take: Callable[[Checkpoint], None]) -> bool:
        """Hand the newest good checkpoint to `take`; return whether there was one.

        A file that cannot be read, or that `take` refuses with an SrnnError, is kept under
        another name, and the one before is tried.
        """
        if self._path is None:
            return False
        for place in (self._path, durable_file.previous(self._path)):
            if not place.exists():
                continue
            try:
                value = checkpoint.load(place)
                take(value)
            except SrnnError as error:
                self._set_aside(place, error)
                continue
            self.version = value.weights.version
            return True
        return False

    def _set_aside(self, place: Path, error: SrnnError) -> None:
        names = (place.with_name(f'{place.name}{BROKEN}{n or ""}') for n in count())
        aside = next(name for name in names if not os.path.lexists(name))
        try:
            place.rename(aside)
            fate = f'kept as {aside.name}'
        except OSError as failure:
            fate = f'cannot be kept aside ({failure})'
        self.broken = '; '.join(filter(None, [self.broken, f'{place} {fate}: {error}']))
