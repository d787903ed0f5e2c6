# SPDX-License-Identifier: Apache-2.0
"""`srnn replay`: what a recorded run has decided, decided again."""

import argparse
from collections.abc import Mapping
from pathlib import Path
import sys
from typing import Any

import numpy as np

from srnn_bringup.command_line import WRONG_USE
from srnn_planner.core import weights_file
from srnn_planner.core.dissonance import SIGNALS
from srnn_replay.counterfactual import Learnt, learn_again
from srnn_replay.errors import ReplayError
from srnn_replay.replay import replay

DIFFERENT = 1


def run_replay(bag: Path, changes: Mapping[str, Any], save: Path | None) -> int:
    """Replay a bag, or learn from it again with other parameters.

    Returns:
        Exit code: 0 if all decisions are identical, 1 if one differs, 2 if they cannot be
        made again.

    """
    try:
        return _learn(bag, changes, save) if changes else _check(bag)
    except ReplayError as error:
        print(f'srnn replay: {error}', file=sys.stderr)
        return WRONG_USE


def _check(bag: Path) -> int:
    found = replay(bag)
    for verdict in found.verdicts:
        print(verdict.words())
    if found.note:
        print(f'{found.note}: the last bit of a number may come out otherwise here')
    speed = found.run_s / max(found.seconds, 1e-9)
    print(f'{found.run_s:.0f} s replayed in {found.seconds:.1f} s, {speed:.0f} times as fast')
    return 0 if found.identical else DIFFERENT


def _learn(bag: Path, changes: Mapping[str, Any], save: Path | None) -> int:
    was, would = learn_again(bag, {}), learn_again(bag, changes)
    print(f'as recorded: {_words(was)}')
    told = ', '.join(f'{name} = {value}' for name, value in changes.items())
    print(f'with {told}: {_words(would)}')
    if was.change.any() and would.change.any():
        alike = np.corrcoef(was.change.ravel(), would.change.ravel())[0, 1]
        print(f'the two changes of the weights correlate by {alike:.3f}')
    if save is not None:
        weights_file.save(save, would.weights)
        print(f'weights: {save}')
    return 0


def _words(learnt: Learnt) -> str:
    numbers = ', '.join(map(str, learnt.updates))
    after = f' (after segments {numbers})' if numbers else ''
    return (
        f'{len(learnt.updates)} updates from {learnt.segments} segments{after}, '
        f'weights changed by up to {np.abs(learnt.change).max():.3f}'
    )


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
        '--save-weights', type=Path, metavar='FILE', help='weights that would have been learned'
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    changes = dict(options.set)
    if options.signal is not None:
        changes['learning.signal'] = options.signal
    if options.save_weights is not None and not changes:
        print('srnn replay: --save-weights needs --signal or --set', file=sys.stderr)
        return WRONG_USE
    return run_replay(options.bag, changes, options.save_weights)


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
