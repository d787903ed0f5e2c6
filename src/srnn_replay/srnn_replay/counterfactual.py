# SPDX-License-Identifier: Apache-2.0
"""The same experience learned from with other parameters: what would have been learned."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from srnn_bag import open_bag
from srnn_config import build, to_mapping
from srnn_msgs_py.journal import Deed
from srnn_msgs_py.ros import executed, segment
from srnn_msgs_py.weights import WeightsUpdate
from srnn_planner.core import belief
from srnn_planner.core.errors import PairingError
from srnn_planner.core.learning_session import LearningSession
from srnn_planner.core.parameters import ModelParameters
from srnn_planner.core.synapses import Synapses
from srnn_replay.errors import NotReplayableError
from srnn_replay.inputs import Inputs
from srnn_replay.origin import RunOrigin
from srnn_replay.recording import Recording, prefixes

NODE = 'adapter'
TOPICS = ('segment', 'executed')


@dataclass(frozen=True, eq=False)
class Learnt:
    """What a run has taught.

    Attributes:
        segments: number of segments that were learned from.
        updates: numbers of those that changed the weights, from 1.
        peaks: (updates,) largest learning rate of each of them.
        weights: the weights at the end, with their version.
        before: the synapses at the beginning.
        after: the synapses at the end.

    """

    segments: int
    updates: tuple[int, ...]
    peaks: tuple[float, ...]
    weights: WeightsUpdate
    before: Synapses
    after: Synapses

    @property
    def largest_change(self) -> float:
        """By how much the weight has changed that has changed most."""
        return abs(belief.change(self.before, self.after).largest)

    def document(self) -> dict[str, Any]:
        """Return what was learned as plain data for JSON."""
        return {
            'segments': self.segments,
            'updates': list(self.updates),
            'peaks': [float(peak) for peak in self.peaks],
            'largest_change': float(self.largest_change),
        }


def learn_again(
    path: Path,
    changes: Mapping[str, Any],
    told: Mapping[str, bytes] | None = None,
    prefix: str | None = None,
) -> Learnt:
    """Learn from the experience of a recorded run, as it would have been with other parameters.

    Args:
        path: a bag.
        changes: values by dotted name below `model`, for example ``learning.signal``.
        told: what the bag does not say of how the graph was started, see `RunOrigin`.
        prefix: namespace of the graph; None if there is only one in the bag.

    Raises:
        BagError: there is no such bag, or it is damaged.
        ConfigError: a parameter does not exist, or cannot have this value.
        NotReplayableError: the bag lacks an experience, or has one of other dimensions.

    """
    bag = open_bag(path)
    origin = RunOrigin(bag, told or {})
    adapter = origin.adapter()
    model = changed(adapter.model, changes)
    had, wanted = adapter.model.network.dimensions, model.network.dimensions
    if wanted != had:
        raise NotReplayableError(
            f'network.dimensions: {wanted}: the experience in {path} has {had}'
        )
    recording = Recording(bag, NODE, TOPICS, prefix or _only(bag.path, prefixes(bag)))
    session = LearningSession(model, adapter.seed, origin.start_weights())
    session.begin()
    before = session.learner.synapses
    updates, peaks, segments = [], [], 0
    for learned in _lessons(recording, session):
        segments += 1
        if learned.updated:
            updates.append(segments)
            peaks.append(learned.peak)
    return Learnt(
        segments, tuple(updates), tuple(peaks), session.model.weights, before,
        session.learner.synapses,
    )  # fmt: skip


def changed(model: ModelParameters, changes: Mapping[str, Any]) -> ModelParameters:
    """Return parameters with other values.

    Raises:
        ConfigError: a name is of none, or a value impossible; the message tells the valid ones.

    """
    tree = to_mapping(model)
    for name, value in changes.items():
        *path, last = name.split('.')
        place = tree
        for step in path:
            place = place.setdefault(step, {})
        place[last] = value
    return build(ModelParameters, tree, 'model')


def _lessons(recording: Recording, session: LearningSession) -> Iterator[Any]:
    plans = Inputs.read(recording, 'segment', segment.from_msg, lambda v: v.stamp_ns)
    paths = Inputs.read(recording, 'executed', executed.from_msg, lambda v: v.stamp_ns)
    for life in recording.sessions:
        for row in life.rows:
            deed, stamp_ns = Deed(int(row[0])), int(row[1])
            try:
                learned = None
                if deed is Deed.PLAN:
                    learned = session.segment(plans[stamp_ns], 0)
                elif deed is Deed.EXECUTED:
                    learned = session.executed(paths[stamp_ns], 0)
            except PairingError:
                continue  # As the node: what does not fit teaches nothing.
            if learned is not None:
                yield learned.lesson


def _only(path: Path, found: list[str]) -> str:
    if len(found) > 1:
        raise NotReplayableError(f'{path}: has several graphs: {", ".join(found)}')
    return found[0]
