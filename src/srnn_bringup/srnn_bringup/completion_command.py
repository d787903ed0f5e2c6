# SPDX-License-Identifier: Apache-2.0
"""`srnn completion`: what a shell needs to complete the command line of `srnn`."""

import argparse
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
import re
from typing import TYPE_CHECKING

from srnn_bringup.config_lookup import arm_names, config_directory, network_names, scene_names
from srnn_bringup.exit_codes import DONE

if TYPE_CHECKING:
    from srnn_bringup.command_line import Parser

SHELLS = ('bash', 'zsh')

_NAMES: dict[str, tuple[str, Callable[[Path], list[str]]]] = {
    'SCENE': ('scene', scene_names),
    'NETWORK': ('network', network_names),
    'DESCRIPTION': ('arm', arm_names),
}
"""By metavar, what is chosen by name or path of a file, and its names."""

_FUNCTIONS = {
    'bash': '_srnn_{kind}() {{ compgen -W "{names}" -- $1; compgen -f -- $1; }}',
    'zsh': "_srnn_{kind}() {{ _alternative '{kind}s:{kind}:({names})' 'files:file:_files' }}",
}
_FILES = ('FILE', 'PICTURE', 'BAG', 'BAG_OR_DIR', 'SOURCE', 'OTHER')
_DIRECTORIES = ('DIR', 'KEYSTORE')


def add_completion(parser: 'Parser', root: 'Parser') -> None:
    """Add the options of the command.

    Args:
        parser: parser of this command.
        root: parser of all commands.

    """
    parser.add_argument('shell', choices=SHELLS, help=f'one of {", ".join(SHELLS)}')
    parser.set_defaults(run=partial(_run, root))


def _run(root: 'Parser', options: argparse.Namespace) -> int:
    print(script(root, options.shell))
    return DONE


def script(root: 'Parser', shell: str) -> str:
    """Return the script that makes a shell complete all commands and options.

    Args:
        root: parser of all commands; it is of no use afterwards.
        shell: one of `SHELLS`.

    """
    import shtab

    for action in _actions(root):
        metavar = action.metavar if isinstance(action.metavar, str) else ''
        if metavar in _FILES:
            action.complete = shtab.FILE  # type: ignore[attr-defined]
        elif metavar in _DIRECTORIES:
            action.complete = shtab.DIRECTORY  # type: ignore[attr-defined]
        elif metavar in _NAMES:
            function = f'_srnn_{_NAMES[metavar][0]}'
            action.complete = dict.fromkeys(SHELLS, function)  # type: ignore[attr-defined]
        # A colon in it would end what zsh reads.
        action.metavar = re.sub(r'\W+', '_', metavar) or None
    preamble = '\n'.join(
        _FUNCTIONS[shell].format(kind=kind, names=' '.join(names(config_directory())))
        for kind, names in _NAMES.values()
    )
    return str(shtab.complete(root, shell=shell, preamble=preamble))


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    for action in parser._actions:
        yield action
        if isinstance(action, argparse._SubParsersAction):
            for child in action.choices.values():
                yield from _actions(child)
