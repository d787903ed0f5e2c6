# SPDX-License-Identifier: Apache-2.0
"""A recorded run replayed, learned from again, or put back on the wire."""

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
import math
from pathlib import Path
import sys
from typing import TYPE_CHECKING, Any

from srnn_bringup.console import Console
from srnn_bringup.errors import Interrupted
from srnn_bringup.exit_codes import DONE, FAILED, by_signal
from srnn_bringup.speech import progress, write_document
from srnn_node.signals import StopRequest
from srnn_planner.core import belief, weights_file
from srnn_replay.counterfactual import Learnt, learn_again
from srnn_replay.replay import replay

if TYPE_CHECKING:
    from tqdm import tqdm


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
        return _learn(bag, changes, save, told, document)
    return _check(bag, told, document)


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


def _check(bag: Path, told: Mapping[str, bytes], document: Path | None) -> int:
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


def _learn(
    bag: Path,
    changes: Mapping[str, Any],
    save: Path | None,
    told: Mapping[str, bytes],
    document: Path | None,
) -> int:
    with progress(2, 'learning again', 'time') as bar:
        was = learn_again(bag, {}, told)
        bar.update()
        would = learn_again(bag, changes, told)
        bar.update()
    print(f'as recorded: {_words(was)}')
    other = ', '.join(f'{name} = {value}' for name, value in changes.items())
    print(f'with {other}: {_words(would)}')
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


def _words(learnt: Learnt) -> str:
    numbers = ', '.join(map(str, learnt.updates))
    after = f' (after segments {numbers})' if numbers else ''
    return (
        f'{len(learnt.updates)} updates from {learnt.segments} segments{after}, '
        f'weights changed by up to {learnt.largest_change:.3f}'
    )
