# SPDX-License-Identifier: Apache-2.0
"""Does what a stranger types in, command after command, in a home of its own."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
import os
from pathlib import Path
import re
import shlex
import signal
import subprocess
import time

LIMIT_S = 120.0
END_S = 30.0
"""How long a command may take to end once it was asked to [s]."""

POLL_S = 0.1

SOURCE = 'REPOSITORY'
"""Stands in commands for where the repository is cloned from."""

ROS_SETUP = 'ROS_SETUP'
"""Stands in commands for the file that brings ROS 2 into a shell."""


@dataclass(frozen=True)
class Step:
    """A command, and what it has to do.

    Attributes:
        why: what the stranger wants; a sentence of the page.
        command: what is typed in, in bash.
        promise: regular expression that the output must have; lines end at ^ and $.
        code: exit code that it must have; None if any will do.
        limit_s: how long it may take, or, until Ctrl-C, to keep its promise [s].
        kept: what it does to the shell, its folder and variables, holds from then on.
        ctrl_c: it goes on until Ctrl-C, which follows its promise and all of `meanwhile`.
        meanwhile: steps in another terminal.

    """

    why: str
    command: str
    promise: str = ''
    code: int | None = 0
    limit_s: float = LIMIT_S
    kept: bool = False
    ctrl_c: bool = False
    meanwhile: tuple['Step', ...] = ()


@dataclass(frozen=True)
class Done:
    """A step that was done.

    Attributes:
        step: which one.
        output: what it printed.
        code: its exit code.
        seconds: how long it took, with all of `meanwhile` [s].
        meanwhile: what was done in another terminal.

    """

    step: Step
    output: str
    code: int
    seconds: float
    meanwhile: tuple['Done', ...] = ()


@dataclass(frozen=True)
class Walk:
    """The steps of a stranger.

    Attributes:
        name: what it is called on the command line.
        title: what it is called on the page.
        begins: what is there already.
        steps: what is done.
        farewell: command without which something would go on.

    """

    name: str
    title: str
    begins: str
    steps: tuple[Step, ...]
    farewell: str = ''


class StepFailedError(Exception):
    """A command did not do what it has to."""


@dataclass
class Shell:
    """Where the stranger is.

    Attributes:
        home: empty folder that is its home.
        environ: variables, `HOME` among them.
        stands_for: words in commands, and what is executed for them.
        say: is told each command as it begins.

    """

    home: Path
    environ: Mapping[str, str]
    stands_for: Mapping[str, str] = field(default_factory=dict)
    say: Callable[[str], None] = print

    def __post_init__(self) -> None:
        """Begin at home."""
        self._environ = {**self.environ, 'HOME': str(self.home), 'PWD': str(self.home)}
        self._kept = self.home / '.kept'
        self._outputs = self.home / '.outputs'
        self._outputs.mkdir()

    def walk(self, steps: Sequence[Step]) -> Iterator[Done]:
        """Do steps, one after the other.

        Raises:
            StepFailedError: the message has the command, what was missed and its last lines.

        """
        for step in steps:
            yield self._do(step)

    def call(self, command: str) -> None:
        """Execute a command that is none of the stranger's."""
        with suppress(StepFailedError):
            self._do(Step('', command))

    def _do(self, step: Step) -> Done:
        self.say(step.command.partition('\n')[0])
        began = time.monotonic()
        log = self._outputs / str(len(list(self._outputs.iterdir())))
        with log.open('wb') as output:
            process = subprocess.Popen(
                ['bash', '-c', self._executed(step)], cwd=self._environ['PWD'],
                env=self._environ, stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT, process_group=0, preexec_fn=_heed_ctrl_c,
            )  # fmt: skip
        running = _Running(step, process, log)
        try:
            meanwhile: tuple[Done, ...] = ()
            if step.ctrl_c:
                running.wait_for_promise(began + step.limit_s)
                meanwhile = tuple(self.walk(step.meanwhile))
                os.killpg(process.pid, signal.SIGINT)
                running.wait_for_end(time.monotonic() + END_S)
            else:
                running.wait_for_end(began + step.limit_s)
        finally:
            running.end()
        running.check()
        if step.kept:
            pairs = self._kept.read_text().split('\0')
            self._environ = dict(pair.split('=', 1) for pair in pairs if '=' in pair)
        return Done(
            step, running.output, process.returncode, time.monotonic() - began, meanwhile
        )

    def _executed(self, step: Step) -> str:
        command = step.command
        for word, real in self.stands_for.items():
            command = re.sub(rf'\b{word}\b', lambda _, real=real: shlex.quote(real), command)
        keep = f' && env -0 > {shlex.quote(str(self._kept))}' if step.kept else ''
        return command + keep


@dataclass(frozen=True)
class _Running:
    step: Step
    process: subprocess.Popen[bytes]
    log: Path

    @property
    def output(self) -> str:
        # As bytes: a return of the carriage is no end of a line.
        return self.log.read_bytes().decode(errors='replace')

    @property
    def kept(self) -> bool:
        return re.search(self.step.promise, self.output, re.MULTILINE) is not None

    def wait_for_promise(self, end: float) -> None:
        while not self.kept:
            if self.process.poll() is not None:
                raise self._failed(f'ended with exit code {self.process.returncode} by itself')
            if time.monotonic() > end:
                raise self._failed(f'has not printed {self.step.promise!r} in time')
            time.sleep(POLL_S)

    def wait_for_end(self, end: float) -> None:
        try:
            self.process.wait(max(end - time.monotonic(), 0.0))
        except subprocess.TimeoutExpired:
            raise self._failed('has not ended in time') from None

    def check(self) -> None:
        """Compare what has happened with what should."""
        if self.step.code not in (None, self.process.returncode):
            raise self._failed(
                f'ended with exit code {self.process.returncode}, not {self.step.code}'
            )
        if not self.kept:
            raise self._failed(f'has not printed {self.step.promise!r}')

    def end(self) -> None:
        """End what still runs of it."""
        for number, seconds in ((signal.SIGTERM, END_S), (signal.SIGKILL, END_S)):
            if self.process.poll() is not None:
                return
            with suppress(ProcessLookupError):
                os.killpg(self.process.pid, number)
            with suppress(subprocess.TimeoutExpired):
                self.process.wait(seconds)

    def _failed(self, why: str) -> StepFailedError:
        last = '\n'.join(self.output.splitlines()[-20:])
        return StepFailedError(f'{self.step.command}\n{why}; its last lines:\n{last}')


def _heed_ctrl_c() -> None:
    # What a script has put into the background ignores it, with all that it starts.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
