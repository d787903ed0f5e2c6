# SPDX-License-Identifier: Apache-2.0
"""Which packages can be imported, tried out in a process that may die of it.

A library of the middleware ends its process when it finds another than it was told of.
"""

from collections.abc import Iterable, Mapping, Sequence
from importlib import import_module
import json
import subprocess
import sys

TRY_S = 120.0
"""Longest wait for all imports on a busy machine [s]."""


def refusals(names: Sequence[str], environ: Mapping[str, str]) -> dict[str, str]:
    """Return why packages cannot be imported, by name; those that can are left out.

    Args:
        names: what to import.
        environ: environment to do it in.

    """
    found: dict[str, str] = {}
    rest = list(names)
    while rest:
        tried, last_words = _try(rest, environ)
        found.update({name: reason for name, reason in tried.items() if reason})
        rest = rest[len(tried) :]
        if rest:
            found[rest.pop(0)] = last_words
    return found


def _try(names: Iterable[str], environ: Mapping[str, str]) -> tuple[dict[str, str], str]:
    """Return what came of each package until the process ended, and its last words."""
    try:
        done = subprocess.run(
            [sys.executable, '-m', __name__, *names], env=dict(environ), capture_output=True,
            text=True, timeout=TRY_S,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return {}, f'does not end within {TRY_S:g} s'
    tried = dict(json.loads(line) for line in done.stdout.splitlines() if line.startswith('["'))
    lines = done.stderr.strip().splitlines() or [f'ends the process with code {done.returncode}']
    return tried, lines[-1]


def main(names: Sequence[str]) -> None:
    """Import one after the other, and print a line of JSON for each: name, and why not."""
    for name in names:
        try:
            import_module(name)
            reason = ''
        except Exception as error:  # any of them means that it cannot be used
            reason = f'{error}' or type(error).__name__
        print(json.dumps([name, reason]), flush=True)


if __name__ == '__main__':
    main(sys.argv[1:])
