# SPDX-License-Identifier: Apache-2.0
"""A peer in a process of its own, with packages of its own if it needs them."""

from contextlib import suppress
import os
from pathlib import Path
import pickle
import subprocess
import sys
from typing import Any

from srnn_bench.errors import PeerError

ONE_THREAD = dict.fromkeys(
    ('OMP_NUM_THREADS', 'OPENBLAS_NUM_THREADS', 'MKL_NUM_THREADS', 'NUMBA_NUM_THREADS'), '1'
)
"""Environment in which numerical libraries use one thread."""


class Remote:
    """Builds an object in another process and runs it there; what it takes is measured there.

    Attributes:
        seconds: what the last call took, without the way to the process and back.

    """

    def __init__(
        self, module: str, name: str, arguments: tuple[Any, ...], apart: Path | None = None
    ) -> None:
        """Start the process and build the object.

        Args:
            module: where its class is.
            name: its class, which has a method `run`.
            arguments: of the class.
            apart: directory of packages that go before those of the environment.

        Raises:
            PeerError: it cannot be built; the text says why.

        """
        environ = {**os.environ, **ONE_THREAD}
        if apart is not None:
            paths = [str(apart), environ.get('PYTHONPATH', '')]
            environ['PYTHONPATH'] = os.pathsep.join(filter(None, paths))
        self.seconds = 0.0
        self._process = subprocess.Popen(
            [sys.executable, '-m', 'srnn_bench.worker'], env=environ,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        try:
            self._ask((module, name, arguments))
        except PeerError:
            self.close()
            raise

    def run(self, *arguments: Any) -> Any:
        """Run the object and return what it returns.

        Raises:
            PeerError: it failed, or its process has ended.

        """
        return self._ask(arguments)

    def close(self) -> None:
        """End the process."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        # Of a process that has ended there may be a request that nobody has read.
        with suppress(BrokenPipeError):
            self._process.stdin.close()
        self._process.stdout.close()
        self._process.wait()

    def _ask(self, request: tuple[Any, ...]) -> Any:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            pickle.dump(request, self._process.stdin)
            self._process.stdin.flush()
            done, result, self.seconds = pickle.load(self._process.stdout)
        except (BrokenPipeError, EOFError, pickle.UnpicklingError) as error:
            raise PeerError(f'its process has ended with code {self._process.wait()}') from error
        if not done:
            raise PeerError(str(result))
        return result
