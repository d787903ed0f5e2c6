# SPDX-License-Identifier: Apache-2.0
"""What is known of a running graph, for whoever draws it."""

from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum, auto

import numpy as np
from numpy.typing import NDArray

from srnn_msgs_py.dissonance import Dissonance
from srnn_msgs_py.health import Health
from srnn_msgs_py.result import ResultCode, SegmentResult
from srnn_view.events import Event, EventLog, of_health, of_result

TRAIL = 12
"""Executed paths that stay to be seen."""

SEGMENTS = 500
"""Segments of which the figures stay."""

EVENTS = 100

Path = NDArray[np.float64]


class Part(Enum):
    """What of a picture is of one piece."""

    ARM = auto()
    PLAN = auto()
    EXECUTED = auto()
    SAMPLES = auto()
    SPIKES = auto()
    BELIEF = auto()
    WAYPOINTS = auto()
    LESSONS = auto()
    PLANNING = auto()
    NODES = auto()
    EVENTS = auto()
    COUNTS = auto()


@dataclass(frozen=True)
class Waypoint:
    """One way point of the tour: where it is, the radius to be reached [m], if it is next."""

    position: tuple[float, float]
    radius: float
    active: bool


@dataclass(frozen=True, eq=False)
class BeliefMap:
    """The learned inhibition.

    Attributes:
        inhibition: (n, m) for rows of equal y, upward, 0 to 1.
        corner: (x, y) of its lower left corner [m].
        cell: width of a cell [m].

    """

    inhibition: NDArray[np.float64]
    corner: tuple[float, float]
    cell: float


@dataclass(eq=False)
class LiveRun:
    """What was heard last; told by method calls, asked by attributes. Its memory is bounded.

    Attributes:
        joints: (n,) measured joint angles [rad]; None before the first.
        plan: (n, 3) segment that was sent last [m].
        executed: executed paths (n, 3), newest last [m].
        samples: (S, T, d) imagined movements behind the newest segment [m].
        kept: how many of them, from the first on, became it.
        spikes: (T, K) how many samples of each neuron spiked in each step.
        belief: what was learned.
        waypoints: the tour.
        lessons: number of the segment, peak of its dissonance, and whether weights changed.
        updates: number of the segment and time that its update took [ms].
        planning: number of the segment and planning time [ms].
        counts: how many segments ended how.
        force: estimated force on the tool [N].
        health: health of each node, by its name.
        log: events, the newest last.

    """

    joints: NDArray[np.float64] | None = None
    plan: Path | None = None
    executed: deque[Path] = field(default_factory=lambda: deque(maxlen=TRAIL))
    samples: NDArray[np.float32] | None = None
    kept: int = 0
    spikes: NDArray[np.uint8] | None = None
    belief: BeliefMap | None = None
    waypoints: tuple[Waypoint, ...] = ()
    lessons: deque[tuple[int, float, bool]] = field(
        default_factory=lambda: deque(maxlen=SEGMENTS)
    )
    updates: deque[tuple[int, float]] = field(default_factory=lambda: deque(maxlen=SEGMENTS))
    planning: deque[tuple[int, float]] = field(default_factory=lambda: deque(maxlen=SEGMENTS))
    counts: dict[ResultCode, int] = field(default_factory=lambda: dict.fromkeys(ResultCode, 0))
    force: float = 0.0
    health: dict[str, Health] = field(default_factory=dict)
    log: EventLog = field(default_factory=lambda: EventLog(EVENTS))
    _changed: set[Part] = field(default_factory=lambda: set(Part))
    _began: float | None = None
    _timed: str = ''

    def changed(self) -> frozenset[Part]:
        """Return what has changed since this was called last, everything at first."""
        changed = frozenset(self._changed)
        self._changed.clear()
        return changed

    @property
    def ended(self) -> int:
        """Segments that were executed, to their end or until they were stopped."""
        refused = (ResultCode.REJECTED, ResultCode.STALE)
        return sum(count for code, count in self.counts.items() if code not in refused)

    def measured(self, joints: NDArray[np.float64]) -> None:
        """Take in joint angles (n,) [rad]."""
        self.joints = joints
        self._changed.add(Part.ARM)

    def pressed(self, newton: float) -> None:
        """Take in the size of the estimated force on the tool [N]."""
        self.force = newton
        self._changed.add(Part.COUNTS)

    def planned(self, path: Path) -> None:
        """Take in the path (n, 3) of a segment that was sent [m]."""
        self.plan = path
        self._changed.add(Part.PLAN)

    def moved(self, path: Path) -> None:
        """Take in an executed path (n, 3) [m]."""
        self.executed.append(path)
        self._changed.add(Part.EXECUTED)

    def imagined(self, samples: NDArray[np.float32], kept: int) -> None:
        """Take in what a segment was chosen from; see `samples` and `kept`."""
        self.samples, self.kept = samples, kept
        self._changed.add(Part.SAMPLES)

    def spiked(self, spikes: NDArray[np.uint8]) -> None:
        """Take in the spikes (T, K) behind a segment."""
        self.spikes = spikes
        self._changed.add(Part.SPIKES)

    def believed(self, belief: BeliefMap) -> None:
        """Take in what was learned."""
        self.belief = belief
        self._changed.add(Part.BELIEF)

    def toured(self, waypoints: tuple[Waypoint, ...]) -> None:
        """Take in the tour."""
        self.waypoints = waypoints
        self._changed.add(Part.WAYPOINTS)

    def ended_as(self, result: SegmentResult, now: float) -> None:
        """Take in how a segment ended, at `now` [s]."""
        self.counts[result.code] += 1
        self._changed.add(Part.COUNTS)
        self._log(of_result(self._since(now), result))

    def learned(self, lesson: Dissonance) -> None:
        """Take in what the adapter made of a segment."""
        number = self.lessons[-1][0] + 1 if self.lessons else 1
        self.lessons.append((number, lesson.peak, lesson.updated))
        if lesson.updated:
            self.updates.append((number, lesson.update_ms))
        self._changed.add(Part.LESSONS)

    def felt(self, health: Mapping[str, Health], now: float) -> None:
        """Take in the health of nodes, by full name, at `now` [s]."""
        self._changed.add(Part.NODES)
        for name, status in health.items():
            short = name.rpartition('/')[2]
            self.health[short] = status
            if short == 'planner':
                self._time(status)
        self._log(of_health(self._since(now), health))

    def _time(self, health: Health) -> None:
        stamp = str(health.values.get('segment_stamp_ns', ''))
        if stamp != self._timed and 'planning_ms' in health.values:
            number = int(health.values.get('planned', len(self.planning) + 1))
            self.planning.append((number, float(health.values['planning_ms'])))
            self._changed.add(Part.PLANNING)
        self._timed = stamp

    def _log(self, events: Iterable[Event]) -> None:
        for event in events:
            if self.log.add(event):
                self._changed.add(Part.EVENTS)

    def _since(self, now: float) -> float:
        if self._began is None:
            self._began = now
        return now - self._began
