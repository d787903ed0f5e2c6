# SPDX-License-Identifier: Apache-2.0
"""Starts processes, notices when one dies, and leaves none behind."""

from collections.abc import Mapping, Sequence
import ctypes
from dataclasses import dataclass
from pathlib import Path
import signal
import subprocess
from types import TracebackType
from typing import Self

from srnn_bringup.errors import NodeDiedError

STEPS = ((signal.SIGINT, 4.0), (signal.SIGTERM, 1.0), (signal.SIGKILL, 2.0))
"""Signals that stop a process, and how long each may take [s]."""

LAST_LINES = 8
"""Lines of output that are shown of a process that died."""

_PR_SET_PDEATHSIG = 1
_LIBC = ctypes.CDLL(None)


@dataclass(frozen=True)
class Command:
    """A process to run.

    Attributes:
        name: what to call it.
        arguments: program and arguments.
        environment: its whole environment.

    """

    name: str
    arguments: Sequence[str]
    environment: Mapping[str, str]


@dataclass(frozen=True)
class Death:
    """The end of a process that nobody asked to end.

    Attributes:
        name: which process.
        code: exit code, or minus the number of the signal.
        last_lines: end of its output.

    """

    name: str
    code: int
    last_lines: tuple[str, ...]

    def words(self) -> str:
        """Return what happened, for a person."""
        if self.code >= 0:
            return f'{self.name} ended with exit code {self.code}'
        return f'{self.name} was killed by {signal.Signals(-self.code).name}'

    def report(self) -> str:
        """Return what happened and the end of the output."""
        return self.words() + ''.join(f'\n  | {line}' for line in self.last_lines)


class Supervisor:
    """Owns the processes of a graph; as a context manager it stops them at its end.

    Every process has a process group of its own, so that Ctrl-C in a terminal reaches
    only the owner, who then stops them in order. Should the owner itself be killed,
    the kernel asks them to stop.
    """

    def __init__(self, directory: Path, steps: Sequence[tuple[signal.Signals, float]] = STEPS):
        """Start nothing yet.

        Args:
            directory: existing directory for the output of the processes.
            steps: signals that stop a process, with the time [s] that each may take.

        """
        self._directory = directory
        self._steps = steps
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self._read: dict[str, int] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.stop()

    @property
    def pids(self) -> dict[str, int]:
        """Process ids by name, in the order of their start."""
        return {name: process.pid for name, process in self._processes.items()}

    def start(self, command: Command) -> None:
        """Start a process; one that has ended is started anew under its old name.

        Raises:
            NodeDiedError: it cannot be started.

        """
        with self._log(command.name).open('ab') as log:
            try:
                self._processes[command.name] = subprocess.Popen(
                    list(command.arguments),
                    env=dict(command.environment),
                    stdin=subprocess.DEVNULL,
                    stdout=log,
                    stderr=subprocess.STDOUT,
                    process_group=0,
                    preexec_fn=_end_with_parent,
                )
            except OSError as error:
                raise NodeDiedError(f'{command.name} cannot be started: {error}') from error

    def alive(self, name: str) -> bool:
        """Tell whether a process runs."""
        return self._processes[name].poll() is None

    def deaths(self) -> list[Death]:
        """Return the ends of the processes that have ended, and were not started anew."""
        return [
            Death(name, code, self.last_lines(name))
            for name, process in self._processes.items()
            if (code := process.poll()) is not None
        ]

    def last_lines(self, name: str, count: int = LAST_LINES) -> tuple[str, ...]:
        """Return the end of the output of a process."""
        text = self._log(name).read_text(encoding='utf-8', errors='replace')
        return tuple(text.splitlines()[-count:])

    def new_lines(self, name: str) -> list[str]:
        """Return the whole lines that a process has printed since this was asked last."""
        begin = self._read.get(name, 0)
        with self._log(name).open('rb') as log:
            log.seek(begin)
            before, end, _ = log.read().rpartition(b'\n')
        whole = before + end
        self._read[name] = begin + len(whole)
        return whole.decode(errors='replace').splitlines()

    def stop(self) -> None:
        """Stop what runs, last started first, each with increasing force."""
        for process in reversed(self._processes.values()):
            self._stop(process)

    def _stop(self, process: subprocess.Popen[bytes]) -> None:
        for number, seconds in self._steps:
            # A process that has ended is reaped by poll, so its id cannot be another's.
            if process.poll() is not None:
                return
            process.send_signal(number)
            try:
                process.wait(seconds)
            except subprocess.TimeoutExpired:
                continue

    def _log(self, name: str) -> Path:
        return self._directory / f'{name}.log'


def _end_with_parent() -> None:
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
