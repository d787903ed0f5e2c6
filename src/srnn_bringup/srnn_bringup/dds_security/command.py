# SPDX-License-Identifier: Apache-2.0
"""`srnn keystore create`: keys and permissions of the graph."""

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from srnn_bringup.environment import DOMAIN_ID, check_environment, domain_id

if TYPE_CHECKING:
    from srnn_bringup.command_line import Parser

CREATE = """\
Make a keystore as `ros2 security` lays it out: an authority, and an enclave with key,
certificate and permissions for every node of the graph and for this command.
"""


def add_keystore_actions(table: 'argparse._SubParsersAction[Parser]') -> 'dict[str, Parser]':
    """Add the actions to the sub-parsers `table`; return their parsers by name."""
    parser = table.add_parser(
        'create', help='make a new keystore', description=CREATE,
        epilog=f'The enclaves may take part in the domain {DOMAIN_ID}, as it is now.',
        allow_abbrev=False,
    )  # fmt: skip
    parser.add_argument(
        'directory', type=Path, metavar='DIR', help='directory to make; may be there if empty'
    )
    parser.set_defaults(run=_create)
    return {'create': parser}


def _create(options: argparse.Namespace) -> int:
    from srnn_bringup.dds_security.enclaves import MEMBERS, enclave
    from srnn_bringup.dds_security.keystore import create_keystore

    check_environment(os.environ)
    domain = domain_id(os.environ)
    create_keystore(options.directory, domain)
    made, private = options.directory, options.directory / 'private'
    print(f'keystore {made} for {DOMAIN_ID} = {domain}')
    print(f'enclaves {", ".join(map(enclave, MEMBERS))}')
    print(f'keep {private} somewhere else: whoever has it lets in anybody, with any right')
    print(f'next: srnn up --secure {made}')
    return 0
