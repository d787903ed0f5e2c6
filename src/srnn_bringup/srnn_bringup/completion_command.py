# SPDX-License-Identifier: Apache-2.0
"""`srnn completion`: what a shell needs to complete the command line of `srnn`."""

import argparse
from collections.abc import Iterator
from functools import partial
import re
from typing import TYPE_CHECKING

from srnn_bringup.config_lookup import config_directory, scene_names
from srnn_bringup.exit_codes import DONE

if TYPE_CHECKING:
    from srnn_bringup.command_line import Parser

SHELLS = ('bash', 'zsh')

_SCENES = '_srnn_scene_or_file'
_FUNCTIONS = {
    'bash': '{function}() {{ compgen -W "{names}" -- $1; compgen -f -- $1; }}',
    'zsh': "{function}() {{ _alternative 'scenes:scene:({names})' 'files:file:_files' }}",
}
_FILES = ('FILE', 'PICTURE', 'BAG', 'BAG_OR_DIR', 'SOURCE', 'OTHER', 'NETWORK')
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
        elif metavar == 'SCENE':
            action.complete = dict.fromkeys(SHELLS, _SCENES)  # type: ignore[attr-defined]
        # A colon in it would end what zsh reads.
        action.metavar = re.sub(r'\W+', '_', metavar) or None
    names = ' '.join(scene_names(config_directory()))
    preamble = _FUNCTIONS[shell].format(function=_SCENES, names=names)
    return str(shtab.complete(root, shell=shell, preamble=preamble))


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    for action in parser._actions:
        yield action
        if isinstance(action, argparse._SubParsersAction):
            for child in action.choices.values():
                yield from _actions(child)
