# SPDX-License-Identifier: Apache-2.0
"""A row of a table before anything was measured, and how it is started."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
import shutil
from time import perf_counter
from typing import Any, Generic, TypeVar

from srnn_bench.errors import ChoiceError, PeerError
from srnn_bench.peers import NOT_INSTALLED, Peer
from srnn_bench.remote import Remote
from srnn_config.nearest import did_you_mean

T = TypeVar('T')


@dataclass(frozen=True)
class Contender(Generic[T]):
    """Who takes part in a table about tasks T.

    Attributes:
        name: what it is called on the command line.
        title: what it is called in the table.
        remark: what a reader must know to compare it.
        module: where its class is, in this package.
        kind: its class, with a method `run`.
        arguments: those of its class, from the task.
        peer: library that it needs, None for none.
        tools: programs that it needs.
        slow: one run of it takes seconds.

    """

    name: str
    title: str
    remark: str
    module: str
    kind: str
    arguments: Callable[[T], tuple[Any, ...]]
    peer: Peer | None = None
    tools: tuple[str, ...] = ()
    slow: bool = False

    def absence(self) -> str:
        """Return why it cannot take part, '' if it can."""
        if self.peer is not None and not self.peer.versions():
            return NOT_INSTALLED
        missing = [tool for tool in self.tools if shutil.which(tool) is None]
        return f'not possible here: there is no {", ".join(missing)}' if missing else ''


@dataclass(eq=False)
class Entry(Generic[T]):
    """A contender that has been started, or why it has not.

    Attributes:
        contender: who it is.
        runner: its object, in a process of its own.
        failure: why there are no figures of it, '' while there are.
        build: seconds until it had been built and had run once.

    """

    contender: Contender[T]
    runner: Remote | None
    failure: str
    build: float

    def run(self, *arguments: Any) -> Any:
        """Run it, and return its result, or None when it has failed now or before."""
        if self.runner is None or self.failure:
            return None
        try:
            return self.runner.run(*arguments)
        except PeerError as error:
            self.failure = f'failed: {error}'
            return None


@contextmanager
def started(
    contenders: Iterable[Contender[T]], task: T, warm_up: tuple[Any, ...]
) -> Iterator[list[Entry[T]]]:
    """Start contenders, run each once with `warm_up`, and end them with the block."""
    with ExitStack() as stack:
        yield [_start(contender, task, warm_up, stack) for contender in contenders]


def _start(
    contender: Contender[T], task: T, warm_up: tuple[Any, ...], stack: ExitStack
) -> Entry[T]:
    absence = contender.absence()
    if absence:
        return Entry(contender, None, absence, 0.0)
    apart = contender.peer.apart if contender.peer is not None else None
    began = perf_counter()
    try:
        runner = Remote(
            f'srnn_bench.{contender.module}', contender.kind, contender.arguments(task), apart
        )
    except PeerError as error:
        return Entry(contender, None, f'failed: {error}', 0.0)
    stack.callback(runner.close)
    entry = Entry(contender, runner, '', 0.0)
    entry.run(*warm_up)
    entry.build = perf_counter() - began
    return entry


def chosen(contenders: Iterable[Contender[T]], names: Iterable[str]) -> list[Contender[T]]:
    """Return those of the contenders that are named, all if no name is given."""
    wanted = set(names)
    return [c for c in contenders if not wanted or c.name in wanted]


def check_names(names: Iterable[str], valid: Iterable[str]) -> None:
    """Refuse names that nobody has.

    Raises:
        ChoiceError: a name is not valid; the text lists those that are.

    """
    known = tuple(valid)
    for name in names:
        if name not in known:
            hint = did_you_mean(name, known)
            raise ChoiceError(f'unknown row {name!r}{hint}; rows: {", ".join(known)}')
