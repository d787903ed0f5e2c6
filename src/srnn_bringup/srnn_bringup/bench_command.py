# SPDX-License-Identifier: Apache-2.0
"""`srnn bench`: the planner beside other simulators and other planners."""

import argparse
import shlex

from srnn_bench.bench import NAMES, REPEATS, Asked, run_bench
from srnn_bringup.config_lookup import config_directory, find_scene
from srnn_bringup.exit_codes import DONE
from srnn_bringup.options import add_scene, add_seed, new_file, whole
from srnn_bringup.speech import remark, write_document
from srnn_bringup.speech_options import add_json
from srnn_config.scene import load_scene

REPEATS_MAX = 10_000


def add_bench(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_scene(parser)
    parser.add_argument(
        '--repeats', type=whole(1, REPEATS_MAX), default=REPEATS, metavar='N',
        help='rounds in which all rows take their turns, each with a seed (default: %(default)s)',
    )
    add_seed(parser, 'first of the seeds')
    parser.add_argument(
        '--only', type=_names, default=(), metavar='NAME[,NAME...]',
        help=f'rows to measure: {", ".join(NAMES)} (default: all)',
    )
    parser.add_argument('--out', type=new_file, metavar='FILE', help='tables to write')
    add_json(parser)
    parser.set_defaults(run=_run)


def _names(text: str) -> tuple[str, ...]:
    return tuple(text.split(','))


def _run(options: argparse.Namespace) -> int:
    scene = load_scene(find_scene(options.scene, config_directory()))
    line = ['srnn', 'bench', '--scene', options.scene, '--repeats', str(options.repeats)]
    line += ['--seed', str(options.seed)]
    if options.only:
        line += ['--only', ','.join(options.only)]
    asked = Asked(scene, options.repeats, options.seed, options.only, shlex.join(line))
    results = run_bench(asked, remark)
    text = results.markdown()
    print(text)
    if options.out is not None:
        options.out.write_text(text, encoding='utf-8')
    if options.json is not None:
        write_document(options.json, results.document())
    return DONE
