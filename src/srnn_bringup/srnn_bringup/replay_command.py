# SPDX-License-Identifier: Apache-2.0
"""`srnn replay`: what a recorded run has decided, decided again."""

import argparse
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
import math
import os
from pathlib import Path
import sys
import tempfile
from typing import TYPE_CHECKING, Any

from srnn_bringup.arms import ARMS
from srnn_bringup.choices import SIMULATED, Choices
from srnn_bringup.config import load
from srnn_bringup.console import Console
from srnn_bringup.environment import check_environment
from srnn_bringup.errors import ChoiceError, Interrupted
from srnn_bringup.exit_codes import DONE, FAILED, by_signal
from srnn_bringup.graph import describe, write_parameters
from srnn_bringup.options import add_network, add_seed, new_file
from srnn_bringup.speech import progress, write_document
from srnn_bringup.speech_options import add_json
from srnn_config import UnknownKeyError, to_mapping
from srnn_node.signals import StopRequest
from srnn_planner.core import belief, weights_file
from srnn_planner.core.dissonance import SIGNALS
from srnn_planner.core.parameters import ModelParameters

if TYPE_CHECKING:
    from tqdm import tqdm

    from srnn_replay.counterfactual import Learnt

RATES = (0.01, 1000.0)


def run_replay(
    bag: Path,
    changes: Mapping[str, Any],
    save: Path | None,
    told: Mapping[str, bytes],
    document: Path | None = None,
) -> int:
    """Replay a bag, or learn from it again with other parameters.

    Args:
        bag: what to replay.
        changes: other parameters of the model, by dotted name; none to replay.
        save: where to write the weights that other parameters would have led to.
        told: what the bag does not say of how the graph was started, see `RunOrigin`.
        document: where to write what was found; None for nowhere.

    Returns:
        Exit code: 0 if all decisions are identical, 1 if one differs.

    Raises:
        BagError: there is no such bag, or it is damaged.
        ReplayError: they cannot be made again.

    """
    if changes:
        return _learn(bag, changes, save, document)
    return _check(bag, told, document)


def _check(bag: Path, told: Mapping[str, bytes], document: Path | None) -> int:
    from srnn_replay.replay import replay

    with ExitStack() as stack:
        bars: list[tqdm[Any]] = []

        def watch(done: int, total: int) -> None:
            if not bars:
                bars.append(stack.enter_context(progress(total, 'replay', 'node')))
            bars[0].update(done - bars[0].n)

        found = replay(bag, told, watch)
    for verdict in found.verdicts:
        print(verdict.words())
    if found.note:
        print(f'{found.note}: the last bit of a number may come out otherwise here')
    speed = found.run_s / max(found.seconds, 1e-9)
    print(f'{found.run_s:.0f} s replayed in {found.seconds:.1f} s, {speed:.0f} times as fast')
    if document is not None:
        write_document(document, found.document())
    return DONE if found.identical else FAILED


def run_publish(bag: Path, topics: Sequence[str], rate: float) -> int:
    """Put the messages of a bag back on the wire; return the exit code."""
    from srnn_bringup.republish import LISTENERS_S, republisher
    from srnn_bringup.session import session

    console = Console(sys.stdout)

    def guard() -> None:
        if stop.name is not None:
            raise Interrupted(stop.name)

    with StopRequest() as stop, session('srnn_replay', guard) as (node, pump):
        try:
            publisher = republisher(node, bag, topics, rate)
            if not pump.until(publisher.heard, LISTENERS_S if topics else 1.0):
                console.note('not every topic has a listener')
            with progress(publisher.count, 'replay', 'message') as bar:
                seconds = publisher.run(pump, bar.update)
        except Interrupted as wish:
            return by_signal(str(wish))
    console.note(f'published {publisher.published} messages in {seconds:.1f} s')
    return DONE


def _learn(
    bag: Path, changes: Mapping[str, Any], save: Path | None, document: Path | None
) -> int:
    from srnn_replay.counterfactual import learn_again

    with progress(2, 'learning again', 'time') as bar:
        was = learn_again(bag, {})
        bar.update()
        would = learn_again(bag, changes)
        bar.update()
    print(f'as recorded: {_words(was)}')
    told = ', '.join(f'{name} = {value}' for name, value in changes.items())
    print(f'with {told}: {_words(would)}')
    alike = None
    same_size = was.before.prior.grid.count == would.before.prior.grid.count
    if was.updates and would.updates and same_size:
        alike = belief.correlation((was.before, was.after), (would.before, would.after))
        print(f'the two changes of the weights correlate by {alike:.3f}')
        alike = alike if math.isfinite(alike) else None
    if save is not None:
        weights_file.save(save, would.weights)
        print(f'weights: {save}')
    if document is not None:
        found = {'recorded': was.document(), 'changes': dict(changes), 'would': would.document()}
        write_document(document, {**found, 'correlation': alike})
    return DONE


def _words(learnt: 'Learnt') -> str:
    numbers = ', '.join(map(str, learnt.updates))
    after = f' (after segments {numbers})' if numbers else ''
    return (
        f'{len(learnt.updates)} updates from {learnt.segments} segments{after}, '
        f'weights changed by up to {learnt.largest_change:.3f}'
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
        '--rate', type=_rate, default=1.0, metavar='R',
        help='with --publish: so many times as fast as recorded (default: %(default)s)',
    )
    add_json(parser, 'what was found')
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    if options.topic and not options.publish:
        raise ChoiceError(f'--topic {options.topic[0]} has no effect without --publish')
    changes = dict(options.set)
    _check_names(changes)
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
