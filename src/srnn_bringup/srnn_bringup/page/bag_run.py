# SPDX-License-Identifier: Apache-2.0
"""A recorded run as a report needs it: segments, weights, tip, events and times."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
import json
from pathlib import Path
import tempfile
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rcl_interfaces.msg import Log
from rclpy.serialization import deserialize_message

from srnn_bag import Bag, Message, open_bag
from srnn_bag.attached import PARAMETERS, RUN, SCENE
from srnn_bringup.choices import ROOT, Choices
from srnn_bringup.config import Configuration, load
from srnn_bringup.config_files import NetworkFile
from srnn_bringup.run_recorder import Recorder, start_recording
from srnn_msgs_py.health import Health, in_namespace
from srnn_msgs_py.ros import (
    diagnostics,
    dissonance,
    executed,
    pose,
    result,
    segment,
    weights,
    wrench,
)
from srnn_msgs_py.weights import WeightsUpdate
from srnn_replay.origin import RunOrigin
from srnn_replay.recording import decode, remapped_topics
from srnn_view.events import Event, EventLog, Grave, of_health, of_result

LOG = '/rosout'
WARNING = 30
"""Severity from which on a line of the log is an event."""

TRUTH = 'contact_truth'
HEALTH = '/diagnostics'
EVENTFUL: Mapping[str, Callable[[float, Any], Iterator[Event]]] = {
    'segment_result': of_result,
    HEALTH: of_health,
}
"""By topic, what events follow from the time and the content of a message."""


@dataclass(frozen=True, eq=False)
class BagRun:
    """One graph of a bag.

    Attributes:
        bag: where it comes from.
        configuration: scene, network and seed of the run.
        recorder: its segments and figures.
        versions: weights, in the order in which they were shared.
        tip: (n, 3) time since the beginning [s] and measured tip [m].
        sent: when each segment was sent since the beginning [s], by its identity.
        events: what else happened, in order.
        about: who recorded what, as attached to the bag.
        seconds: how long it took [s].

    """

    bag: Bag
    configuration: Configuration
    recorder: Recorder
    versions: tuple[tuple[float, WeightsUpdate], ...]
    tip: NDArray[np.float64]
    sent: dict[int, float]
    events: tuple[Event, ...]
    about: dict[str, Any]
    seconds: float


def read_run(path: Path) -> BagRun:
    """Read a recorded run.

    Raises:
        BagError: there is no such bag, or it is damaged.
        NotReplayableError: nothing in it tells how the graph was started.

    """
    bag = open_bag(path)
    configuration = _configuration(bag)
    recorder = start_recording(configuration)
    reader = _Reader(bag)
    since = reader.since
    events: list[Event] = []
    heard: list[tuple[int, Callable[[], None]]] = []
    found: dict[str, list[tuple[Message, Any]]] = {}
    for name, convert, take in (
        ('segment', segment.from_msg, recorder.segment),
        ('executed', executed.from_msg, recorder.executed),
        ('segment_result', result.from_msg, recorder.result),
        ('dissonance', dissonance.from_msg, recorder.dissonance),
        ('weights', weights.from_msg, recorder.weights),
        (TRUTH, _force, recorder.force),
        (HEALTH, reader.own_health, recorder.health),
    ):
        found[name] = reader.values(name, convert)
        for message, value in found[name]:
            heard.append((message.received_ns, lambda t=take, v=value: t(v)))  # type: ignore[misc]
            if name in EVENTFUL:
                events += EVENTFUL[name](since(message.received_ns), value)
    for _, act in sorted(heard, key=lambda one: one[0]):
        act()
    for message in bag.messages({LOG}):
        events += _of_log(since(message.received_ns), message.data, reader.namespace)
    log = EventLog()
    for event in sorted(events, key=lambda event: event.time):
        log.add(event)
    tip = [(since(m.received_ns), *v.position[:2])
           for m, v in reader.values('current_pose', pose.from_msg)]  # fmt: skip
    return BagRun(
        bag=bag,
        configuration=configuration,
        recorder=recorder,
        versions=tuple((since(m.received_ns), v) for m, v in found['weights']),
        tip=np.array(tip).reshape(-1, 3),
        sent={v.stamp_ns: since(m.received_ns) for m, v in found['segment']},
        events=tuple(log.events),
        about=json.loads(bag.attachments[RUN]),
        seconds=since(reader.ended_ns),
    )


class _Reader:
    """Finds the topics of one graph in a bag, whatever namespace they are in."""

    def __init__(self, bag: Bag) -> None:
        self._bag, self._remapped = bag, remapped_topics(bag)
        names = {name for name in bag.topics if name.rpartition('/')[2] == 'segment'}
        self._prefix = min(names, default='/segment')[: -len('segment')]
        self.namespace = self._prefix.rstrip('/') or ROOT
        moved = {self._full('segment'), self._full('executed')}
        stamps = [message.received_ns for message in bag.messages(moved)]
        self._began_ns, self.ended_ns = min(stamps, default=0), max(stamps, default=0)

    def since(self, ns: int) -> float:
        """Return the time since the first of its segments [s]."""
        return 1e-9 * (ns - self._began_ns)

    def own_health(self, msg: Any) -> Mapping[str, Health]:
        return in_namespace(diagnostics.from_msg(msg), self.namespace)

    def values(self, name: str, convert: Callable[[Any], Any]) -> list[tuple[Message, Any]]:
        found = decode(name, self._bag.messages({self._full(name)}), convert)
        return [(one.message, one.value) for one in found]

    def _full(self, name: str) -> str:
        own = name if name.startswith('/') else f'{self._prefix}{name}'
        return self._remapped.get(own, own)


def _configuration(bag: Bag) -> Configuration:
    """Return what the graph was told, as far as the bag has it."""
    origin = RunOrigin(bag).planner()
    # An arm may go by what another one learns.
    learns = PARAMETERS.format('adapter') in bag.attachments
    model = RunOrigin(bag).adapter().model if learns else origin.model
    about = json.loads(bag.attachments[RUN])
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder, SCENE)
        scene.write_bytes(bag.attachments[SCENE])
        here = load(Choices(scene=str(scene)))
    network = NetworkFile(model=model, planning=origin.planning)
    return replace(
        here, scene=origin.scene, network=network, seed=origin.seed,
        robot=about.get('arm', here.robot),
    )  # fmt: skip


def _of_log(time: float, data: bytes, namespace: str) -> Iterator[Event]:
    """Yield a line of the log that warns, if it is of a node in a namespace."""
    line = deserialize_message(data, Log)
    # A logger is named after its node, with dots instead of slashes.
    inside = line.name.rpartition('.')[0] == namespace.strip('/').replace('/', '.')
    if line.level >= WARNING and inside:
        grave = Grave.ERROR if line.level > WARNING else Grave.WARN
        yield Event(time, f'{line.name} (log)', grave, line.msg, said_again=True)


def _force(msg: Any) -> float:
    return float(np.linalg.norm(wrench.from_msg(msg).force))
