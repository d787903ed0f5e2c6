# SPDX-License-Identifier: Apache-2.0
"""`srnn up`: the graph, until its user ends it."""

import argparse

from srnn_bringup.graph_options import add_up_options, configuration
from srnn_bringup.options import add_peers


def add_up(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_up_options(parser)
    add_peers(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    told = configuration(options)
    from srnn_bringup.up import run_up

    return run_up(told, options.only, options.peer, options.record, options.view)
