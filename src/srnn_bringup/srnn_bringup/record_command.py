# SPDX-License-Identifier: Apache-2.0
"""`srnn record`: what a running graph says, in a new bag."""

import argparse
import os

from srnn_bringup.environment import check_environment
from srnn_bringup.options import add_remappings, add_running_graph, new_bag


def add_record(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument('bag', type=new_bag, metavar='BAG', help='new directory to record to')
    add_running_graph(parser)
    add_remappings(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    check_environment(os.environ)
    from srnn_bringup.record import run_record

    return run_record(
        options.bag, options.peer, options.secure, options.namespace, options.remap
    )
