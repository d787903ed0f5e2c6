# SPDX-License-Identifier: Apache-2.0
"""The command line of `srnn experiment`."""

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING

from srnn_bringup.choices import (
    ARM_DESCRIPTION,
    NETWORK,
    SEED_MAX,
    STANDARD_SCENE,
    Choices,
)
from srnn_bringup.command_line import Parser
from srnn_bringup.config_lookup import config_directory, find_scene
from srnn_bringup.errors import ChoiceError
from srnn_bringup.idle_options import refuse_idle
from srnn_bringup.options import (
    add_arm_description,
    add_learning,
    add_network,
    add_scene,
    add_seed,
    new_directory,
    new_file,
    whole,
)
from srnn_bringup.sections import EXECUTION
from srnn_bringup.speech_options import add_json
from srnn_experiments.choices import AGENTS, WORLDS
from srnn_experiments.random_scenes_report import HELD_OUT

if TYPE_CHECKING:
    from srnn_bringup.config import Configuration
    from srnn_experiments.campaign import Scheduler
    from srnn_experiments.setting import Setting

PAPER = 'network_paper'
SEGMENTS, TRIALS = 300, 10
"""Length and number of trials, as in the paper."""

SCENES = 100

LONG = 1000
"""Segments of a trial with a constant rate, in which a model may collapse."""

TARGET_SCENE = 'transfer'

SEGMENTS_MAX, TRIALS_MAX, WORKERS_MAX = 100_000, 100_000, 1024

OF_NETWORK = {
    'network': NETWORK, 'signal': None, 'alpha': None, 'weights': None, 'save_weights': None,
}  # fmt: skip
"""Options about a network, with their defaults."""

Run = Callable[[argparse.Namespace], int]


def add_experiments(
    table: 'argparse._SubParsersAction[Parser]',
) -> dict[str, Parser]:
    """Add the experiments to the table of commands; return their parsers by name."""
    parsers = {}
    for name, text, add, run in (
        ('run', 'Do many trials of one setting on simulated time.', _add_run, _run),
        ('random', 'Random solvable scenes, one trial each.', _add_random, _random),
        ('transfer', 'Learn in one world, go on in another with a new obstacle.',
         _add_transfer, _transfer),
        ('table1', "The paper's Table 1, beside the paper's own numbers.", _add_table, _table1),
        ('figures', "The figures of the paper's evaluation.", _add_figures, _figures),
    ):
        parser = table.add_parser(name, help=text, description=text, allow_abbrev=False)
        add(parser)
        parser.set_defaults(run=run)
        parsers[name] = parser
    return parsers


def _add_common(parser: Parser, trials: int) -> None:
    add_scene(parser)
    parser.add_argument(
        '--trials', type=whole(1, TRIALS_MAX), default=trials, metavar='M',
        help='number of trials (default: %(default)s)',
    )
    add_seed(parser, 'seed of the first trial, the others follow')
    _add_execution(parser)


def _add_execution(parser: Parser) -> None:
    """Add how long trials are, and where they are done."""
    parser.add_argument(
        '--segments', type=whole(1, SEGMENTS_MAX), default=SEGMENTS, metavar='N',
        help='length of a trial (default: %(default)s)',
    )
    where = parser.section(EXECUTION).add_mutually_exclusive_group()
    where.add_argument(
        '--workers', type=whole(1, WORKERS_MAX), metavar='W',
        help='processes on this machine (default: one per core)',
    )
    where.add_argument(
        '--scheduler', metavar='ADDRESS', help='Dask scheduler to use instead, as tcp://host:8786'
    )


def _add_world(parser: Parser) -> None:
    parser.add_argument(
        '--world', choices=WORLDS, default='mujoco',
        help='the simulated arm, or a point that stops at obstacles (default: %(default)s)',
    )
    add_arm_description(parser)


def _add_run(parser: Parser) -> None:
    _add_common(parser, trials=1)
    _add_world(parser)
    add_network(parser)
    parser.add_argument(
        '--agent', choices=AGENTS, default='network',
        help='the network, the same told of all obstacles, or A* that marks contacts '
        '(default: %(default)s)',
    )
    add_learning(parser)
    parser.add_argument(
        '--save-weights', type=new_file, metavar='FILE',
        help='where to write the weights at the end of the first trial',
    )
    add_json(parser)


def _add_random(parser: Parser) -> None:
    parser.add_argument(
        '--first', type=whole(0, SEED_MAX), default=HELD_OUT, metavar='S',
        help='seed of the first scene, the others follow (default: %(default)s)',
    )
    parser.add_argument(
        '--scenes', type=whole(1, TRIALS_MAX), default=SCENES, metavar='N',
        help='number of scenes (default: %(default)s)',
    )
    _add_execution(parser)
    _add_world(parser)
    add_network(parser)
    _add_out(parser)


def _add_transfer(parser: Parser) -> None:
    _add_common(parser, TRIALS)
    parser.add_argument(
        '--target', default=TARGET_SCENE, metavar='SCENE',
        help='scene of phase 2: all obstacles of that of phase 1 (--scene), and new ones '
        '(default: %(default)s)',
    )
    add_arm_description(parser)
    add_network(parser)
    _add_out(parser)


def _add_table(parser: Parser) -> None:
    _add_common(parser, TRIALS)
    _add_world(parser)
    add_network(parser, PAPER)
    _add_out(parser)


def _add_figures(parser: Parser) -> None:
    _add_table(parser)
    parser.add_argument(
        '--long', type=whole(1, SEGMENTS_MAX), default=LONG, metavar='N',
        help='length of the trials with a constant rate (default: %(default)s)',
    )


def _add_out(parser: Parser) -> None:
    parser.add_argument(
        '--out', type=new_directory, required=True, metavar='DIR', help='directory to write to'
    )


def _configuration(options: argparse.Namespace) -> 'Configuration':
    """Return what trials are done with; random scenes take the place of the standard one."""
    from srnn_bringup.config import load

    arm, world = options.arm_description, getattr(options, 'world', 'mujoco')
    if world == 'point' and arm != ARM_DESCRIPTION:
        raise ChoiceError(
            f"arm-description '{arm}' has no effect in world 'point', which has no arm; "
            "it is for world 'mujoco'"
        )
    return load(
        Choices(
            description=arm,
            scene=getattr(options, 'scene', STANDARD_SCENE),
            network=options.network,
            signal=getattr(options, 'signal', None),
            alpha=getattr(options, 'alpha', None),
            seed=getattr(options, 'seed', 0),
            initial_weights=getattr(options, 'weights', None),
        )
    )


def _asked(
    options: argparse.Namespace, first: int, count: int, world: str
) -> 'tuple[Setting, range, Scheduler]':
    """Return what trials are done with, with which seeds, and where."""
    from srnn_bringup.experiments.run import base_setting, make_scheduler

    base = base_setting(_configuration(options), options.segments, world)
    return base, range(first, first + count), make_scheduler(options.workers, options.scheduler)


def _run(options: argparse.Namespace) -> int:
    from srnn_bringup.experiments.run import Experiment, run_experiment

    if options.agent == 'grid':
        refuse_idle(options, OF_NETWORK, 'with --agent grid, which has no network')
    asked = Experiment(
        segments=options.segments, trials=options.trials, seed=options.seed,
        world=options.world, agent=options.agent, workers=options.workers,
        scheduler=options.scheduler, json=options.json, save_weights=options.save_weights,
    )
    return run_experiment(_configuration(options), asked, print)


def _random(options: argparse.Namespace) -> int:
    from srnn_bringup.experiments.random_scenes import run_random_scenes

    base, seeds, scheduler = _asked(options, options.first, options.scenes, options.world)
    return run_random_scenes(base, seeds, scheduler, options.out, print)


def _transfer(options: argparse.Namespace) -> int:
    from srnn_bringup.experiments.transfer import run_transfer
    from srnn_config.scene import load_scene
    from srnn_experiments.transfer import transfers

    target = load_scene(find_scene(options.target, config_directory()))
    base, seeds, scheduler = _asked(options, options.seed, options.trials, 'mujoco')
    return run_transfer(transfers(base, target), seeds, scheduler, options.out, print)


def _table1(options: argparse.Namespace) -> int:
    from srnn_bringup.experiments.table1 import run_table1

    base, seeds, scheduler = _asked(options, options.seed, options.trials, options.world)
    return run_table1(base, seeds, scheduler, options.out, print)


def _figures(options: argparse.Namespace) -> int:
    from srnn_bringup.experiments.figures import run_paper_figures

    base, seeds, scheduler = _asked(options, options.seed, options.trials, options.world)
    return run_paper_figures(base, seeds, options.long, scheduler, options.out, print)
