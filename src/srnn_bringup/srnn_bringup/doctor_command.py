# SPDX-License-Identifier: Apache-2.0
"""The command line of `srnn doctor`."""

import argparse

from srnn_bringup.speech import write_document
from srnn_bringup.speech_options import add_json


def add_doctor(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_json(parser, 'findings')
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from srnn_bringup.doctor.examination import run_doctor

    code, found = run_doctor(print)
    if options.json is not None:
        write_document(options.json, found)
    return code
