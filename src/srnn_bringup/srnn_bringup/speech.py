# SPDX-License-Identifier: Apache-2.0
"""What a command says: words for people, a document for machines, how far it is."""

from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager, redirect_stdout
from contextvars import ContextVar
from dataclasses import dataclass
import json
import os
from pathlib import Path
import sys
from typing import TYPE_CHECKING, Any, TextIO

if TYPE_CHECKING:
    from tqdm import tqdm

STDOUT = Path('-')
"""Stands for the standard output, where a file is asked for."""


@dataclass(frozen=True)
class _Voice:
    """Where documents go, and whether anything else is said."""

    documents: TextIO | None = None
    quiet: bool = False


_VOICE: ContextVar[_Voice] = ContextVar('_VOICE')


def _voice() -> _Voice:
    return _VOICE.get(_Voice())


@contextmanager
def speaking(quiet: bool, document: Path | None) -> Iterator[None]:
    """Say things as the user wants them meanwhile; errors are always on standard error.

    Args:
        quiet: say no words, and show no progress.
        document: where the document goes. If this is `STDOUT`, nothing else is said
            there: words go to standard error.

    """
    with ExitStack() as stack:
        token = _VOICE.set(_Voice(sys.stdout, quiet))
        stack.callback(_VOICE.reset, token)
        if quiet:
            silence = stack.enter_context(open(os.devnull, 'w', encoding='utf-8'))
            stack.enter_context(redirect_stdout(silence))
        elif document == STDOUT:
            stack.enter_context(redirect_stdout(sys.stderr))
        yield


def write_document(path: Path, document: Mapping[str, Any]) -> None:
    """Write a document as JSON, to a file or to `STDOUT`.

    Raises:
        OSError: the file cannot be written.

    """
    text = json.dumps(document, indent=2, allow_nan=False) + '\n'
    if path != STDOUT:
        path.write_text(text, encoding='utf-8')
        return
    stream = _voice().documents or sys.stdout
    stream.write(text)
    stream.flush()


def progress(total: int, title: str, unit: str) -> 'tqdm[Any]':
    """Return a bar on standard error; none is shown to those who want quiet."""
    from tqdm import tqdm

    return tqdm(
        total=total, desc=title, unit=unit, file=sys.stderr, disable=_voice().quiet
    )


def remark(text: str) -> None:
    """Say on standard error how far something is, but not to those who want quiet."""
    if not _voice().quiet:
        print(text, file=sys.stderr)
