# SPDX-License-Identifier: Apache-2.0
"""`srnn demo`: an obstacle is learned live on the simulated arm."""

import argparse
from pathlib import Path

from srnn_bringup.arms import ARMS
from srnn_bringup.choices import FRI, SIMULATED
from srnn_bringup.graph_options import add_graph, configuration
from srnn_bringup.options import picture_file, whole
from srnn_bringup.speech_options import add_json

SEGMENTS = 150
"""About three minutes of the standard scene."""

SEGMENTS_MAX = 100_000


def add_demo(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_graph(
        parser,
        {SIMULATED: ARMS[SIMULATED], FRI: 'the same behind FRI and an emulated controller'},
    )
    parser.add_argument(
        '--segments', type=whole(1, SEGMENTS_MAX), default=SEGMENTS, metavar='N',
        help='segments to execute (default: %(default)s, about three minutes)',
    )
    add_json(parser)
    parser.add_argument(
        '--picture', type=picture_file, default=Path('demo.png'), metavar='FILE',
        help='picture to write (default: %(default)s)',
    )  # fmt: skip
    parser.set_defaults(run=_run, emulator=None)


def _run(options: argparse.Namespace) -> int:
    told = configuration(options)
    from srnn_bringup.demo import run_demo
    from srnn_bringup.run_outputs import Outputs

    outputs = Outputs(options.picture, options.json, options.save_weights)
    return run_demo(told, options.segments, outputs, options.record, options.view)
