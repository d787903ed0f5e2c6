# SPDX-License-Identifier: Apache-2.0
"""`srnn key`: makes the key by which the nodes of a graph know each other."""

import argparse
from pathlib import Path

from srnn_access import key_file
from srnn_bringup.command_line import Parser
from srnn_bringup.options import new_file


def add_key_actions(table: 'argparse._SubParsersAction[Parser]') -> dict[str, Parser]:
    """Add the actions to the sub-parsers `table`; return their parsers by name."""
    text = 'Write a new random key, readable by its owner alone; no file is overwritten.'
    parser = table.add_parser('create', help=text, description=text, allow_abbrev=False)
    parser.add_argument('file', type=new_file, metavar='FILE', help='key file to write')
    parser.set_defaults(run=_create)
    return {'create': parser}


def add_key(parser: argparse.ArgumentParser) -> None:
    """Add the choice of a key."""
    parser.add_argument(
        '--key', type=Path, metavar='FILE',
        help='key file; messages between nodes are sealed, and all others refused',
    )


def _create(options: argparse.Namespace) -> int:
    key = key_file.create(options.file)
    print(f'{options.file}: new key {key.fingerprint}')
    return 0
