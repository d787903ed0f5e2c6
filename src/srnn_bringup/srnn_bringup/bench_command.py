# SPDX-License-Identifier: Apache-2.0
"""`srnn bench`: the planner beside other simulators and other planners."""

import argparse
import json
import shlex
import sys

from srnn_bench.bench import NAMES, REPEATS, Asked, run_bench
from srnn_bringup.config_lookup import config_directory, find_scene
from srnn_bringup.options import add_scene, add_seed, new_file, whole
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
    parser.add_argument('--json', type=new_file, metavar='FILE', help='figures to write')
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
    results = run_bench(asked, lambda text: print(text, file=sys.stderr))
    text = results.markdown()
    print(text)
    if options.out is not None:
        options.out.write_text(text, encoding='utf-8')
    if options.json is not None:
        options.json.write_text(
            json.dumps(results.document(), indent=2, allow_nan=False) + '\n', encoding='utf-8'
        )
    return 0
