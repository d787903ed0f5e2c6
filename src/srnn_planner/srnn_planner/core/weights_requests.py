# SPDX-License-Identifier: Apache-2.0
"""What people ask an adapter for: save the weights, load others, go back to the start."""

from collections.abc import Callable

from srnn_msgs_py.journal import Deed
from srnn_planner.core import weights_file
from srnn_planner.core.errors import SrnnError
from srnn_planner.core.learned_model import LearnedModel


class WeightsRequests:
    """Each request returns in words what was done."""

    def __init__(
        self,
        model: LearnedModel,
        file: str,
        now: Callable[[], int],
        changed: Callable[[Deed, int], None],
    ) -> None:
        """Serve a model.

        Args:
            model: the weights.
            file: where they are saved and loaded, empty for nowhere.
            now: returns the time [ns].
            changed: told of other weights by what was done, and `first` of its deed.

        """
        self._model = model
        self._path = file
        self._now = now
        self._changed = changed

    def save(self) -> str:
        """Write the weights.

        Raises:
            SrnnError: there is no file, or it cannot be written.

        """
        value = self._model.weights
        weights_file.save(self._file(), value)
        return f'saved version {value.version} to {self._path}'

    def load(self) -> str:
        """Go on from the weights of the file.

        Raises:
            SrnnError: there is no file, or no weights for this network in it.

        """
        self._model.load(weights_file.load(self._file()), self._now())
        version = self._model.weights.version
        self._changed(Deed.LOAD, version)
        return f'loaded {self._path} as version {version}'

    def revert(self) -> str:
        """Go back to the weights that learning began from."""
        self._model.revert(self._now())
        self._changed(Deed.REVERT, 0)
        return f'back to the initial weights as version {self._model.weights.version}'

    def _file(self) -> str:
        if not self._path:
            raise SrnnError('parameter weights_file is empty: name a file to use this service')
        return self._path
