# SPDX-License-Identifier: Apache-2.0
"""The process in which a peer runs: builds one object, and calls its `run` when asked.

Requests and replies are pickles on standard input and output, see `remote`.
"""

from importlib import import_module
import os
import pickle
import sys
from time import perf_counter
from typing import Any, BinaryIO


def serve(requests: BinaryIO, replies: BinaryIO) -> None:
    """Build what the first request says, then run it for each further one.

    The first request is (module, class, arguments), all others are the arguments of `run`.
    A reply is (True, result, seconds that it took) or (False, what went wrong, seconds); the
    first has the result None.
    """
    module, name, arguments = pickle.load(requests)
    built: list[Any] = []

    def build() -> None:
        built.append(getattr(import_module(module), name)(*arguments))

    _reply(replies, build, ())
    while True:
        try:
            asked = pickle.load(requests)
        except EOFError:
            return
        _reply(replies, built[0].run, asked)


def _reply(replies: BinaryIO, call: Any, arguments: tuple[Any, ...]) -> None:
    began = perf_counter()
    try:
        done, result = True, call(*arguments)
    # Whatever a peer raises becomes a line of the table.
    except Exception as error:
        lines = str(error).strip().splitlines() or ['']
        done, result = False, f'{type(error).__name__}: {lines[-1]}'
    pickle.dump((done, result, perf_counter() - began), replies)
    replies.flush()


def main() -> None:
    """Serve until standard input is closed."""
    replies = os.fdopen(os.dup(1), 'wb')
    # What a library prints must not come between the replies.
    os.dup2(2, 1)
    serve(sys.stdin.buffer, replies)


if __name__ == '__main__':
    main()
