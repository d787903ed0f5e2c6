# SPDX-License-Identifier: Apache-2.0
"""`srnn pause` and `srnn resume`: a running graph at rest, and on its way again."""

import argparse
import os

from srnn_bringup.environment import check_environment
from srnn_bringup.options import add_running_graph


def add_pause(parser: argparse.ArgumentParser) -> None:
    """Add the options of `srnn pause`."""
    add_running_graph(parser)
    parser.set_defaults(run=_pause)


def add_resume(parser: argparse.ArgumentParser) -> None:
    """Add the options of `srnn resume`."""
    add_running_graph(parser)
    parser.set_defaults(run=_resume)


def _pause(options: argparse.Namespace) -> int:
    check_environment(os.environ)
    from srnn_bringup.pausing import run_pause

    return run_pause(options.peer, options.secure, options.namespace)


def _resume(options: argparse.Namespace) -> int:
    check_environment(os.environ)
    from srnn_bringup.pausing import run_resume

    return run_resume(options.peer, options.secure, options.namespace)
