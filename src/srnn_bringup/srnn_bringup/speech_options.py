# SPDX-License-Identifier: Apache-2.0
"""The options by which a user chooses what a command says."""

import argparse
from pathlib import Path

from srnn_bringup.options import new_file
from srnn_bringup.speech import STDOUT


def add_json(parser: argparse.ArgumentParser, what: str = 'figures') -> None:
    """Add a document for machines."""
    parser.add_argument(
        '--json', type=document, metavar='FILE',
        help=f'{what} to write; - for standard output, where nothing else is said then',
    )


def add_quiet(parser: argparse.ArgumentParser) -> None:
    """Add the wish for silence."""
    parser.add_argument(
        '-q', '--quiet', action='store_true',
        help='say nothing but errors, and show no progress',
    )


def document(text: str) -> Path:
    """Read where a document goes: a file that can be written, or `STDOUT`."""
    return STDOUT if text == str(STDOUT) else new_file(text)
