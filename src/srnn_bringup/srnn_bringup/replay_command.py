# SPDX-License-Identifier: Apache-2.0
"""`srnn replay`: what a recorded run has decided, decided again."""

import argparse
from collections.abc import Mapping
import math
import os
from pathlib import Path
import tempfile
from typing import Any

from srnn_bringup.arms import ARMS
from srnn_bringup.choices import NETWORK, SIMULATED, Choices
from srnn_bringup.environment import check_environment
from srnn_bringup.errors import ChoiceError
from srnn_bringup.graph import describe, write_parameters
from srnn_bringup.idle_options import refuse_idle
from srnn_bringup.options import add_network, add_seed, new_file
from srnn_bringup.speech_options import add_json
from srnn_config import UnknownKeyError, to_mapping
from srnn_planner.core.dissonance import SIGNALS
from srnn_planner.core.parameters import ModelParameters

RATE, RATES = 1.0, (0.01, 1000.0)

CHANGING: Mapping[str, Any] = {'signal': None, 'set': [], 'save_weights': None}
"""Options that learn something else from a bag, with their defaults."""

TELLING: Mapping[str, Any] = {'scene': None, 'network': NETWORK, 'seed': 0, 'arm': SIMULATED}
"""Options that say what a bag does not, with their defaults."""


def add_replay(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument('bag', type=Path, metavar='BAG', help='directory or file of a recording')
    parser.add_argument(
        '--signal', choices=tuple(SIGNALS),
        help='learn from the same experience with another signal, and compare',
    )
    parser.add_argument(
        '--set', type=_setting, action='append', default=[], metavar='KEY=VALUE',
        help='the same with another parameter of the model, for example learning.replays=40',
    )
    parser.add_argument(
        '--save-weights', type=new_file, metavar='FILE',
        help='weights that would have been learned',
    )
    parser.add_argument(
        '--scene', metavar='SCENE',
        help='scene of a bag that does not tell: `ros2 bag record` attaches nothing',
    )
    add_network(parser)
    add_seed(parser, 'with --scene: seed of the run')
    parser.add_argument(
        '--arm', choices=tuple(ARMS), default=SIMULATED,
        help='with --scene: arm of the run (default: %(default)s)',
    )
    parser.add_argument(
        '--publish', action='store_true',
        help='put the messages back on the wire instead, with the time of the recording on /clock',
    )
    parser.add_argument(
        '--topic', action='append', default=[], metavar='NAME',
        help='with --publish: this topic only; repeatable (default: all)',
    )
    parser.add_argument(
        '--rate', type=_rate, default=RATE, metavar='R',
        help='with --publish: so many times as fast as recorded (default: %(default)s)',
    )
    add_json(parser, 'what was found')
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    if options.publish:
        refuse_idle(options, {**CHANGING, **TELLING, 'json': None}, 'with --publish')
    else:
        refuse_idle(options, {'topic': [], 'rate': RATE}, 'without --publish')
    if options.scene is None:
        refuse_idle(options, TELLING, 'without --scene')
    changes = dict(options.set)
    _check_names(changes)
    from srnn_bringup.replay import run_publish, run_replay

    if options.publish:
        check_environment(os.environ)
        return run_publish(options.bag, options.topic, options.rate)
    if options.signal is not None:
        changes['learning.signal'] = options.signal
    if options.save_weights is not None and not changes:
        raise ChoiceError('--save-weights needs --signal or --set')
    told = {} if options.scene is None else _told(options)
    return run_replay(options.bag, changes, options.save_weights, told, options.json)


def _check_names(changes: Mapping[str, Any]) -> None:
    """Refuse names of no parameter before the bag is read, which takes a while.

    Raises:
        ConfigError: a name is of none; the message tells the valid ones.

    """
    places = {name.rpartition('.')[0] for name in changes}
    valid = _parameters(to_mapping(ModelParameters()), '')
    for name in changes:
        if name not in valid:
            near = [known for known in valid if known.rpartition('.')[0] in places]
            raise UnknownKeyError('--set', name, near or valid)


def _parameters(tree: Mapping[str, Any], prefix: str) -> list[str]:
    """Return the dotted names of all parameters."""
    names = []
    for name, value in tree.items():
        inside = isinstance(value, Mapping)
        names += _parameters(value, f'{prefix}{name}.') if inside else [prefix + name]
    return names


def _told(options: argparse.Namespace) -> dict[str, bytes]:
    """Return the files that a bag of such a graph would have attached."""
    from srnn_bringup.bag_attachments import of_run
    from srnn_bringup.config import load

    configuration = load(
        Choices(
            arm=options.arm, scene=options.scene, network=options.network, seed=options.seed
        )
    )
    with tempfile.TemporaryDirectory() as folder:
        files = write_parameters(describe(configuration), Path(folder))
        return {file.name: file.data for file in of_run(configuration, files)}


def _rate(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not RATES[0] <= value <= RATES[1]:
        raise argparse.ArgumentTypeError(f'{text!r}: must be a number from 0.01 to 1000')
    return value


def _setting(text: str) -> tuple[str, Any]:
    name, sign, value = text.partition('=')
    if not (name and sign and value):
        raise argparse.ArgumentTypeError(f'{text!r}: must be KEY=VALUE')
    for kind in (int, float):
        try:
            return name, kind(value)
        except ValueError:
            continue
    return name, value
