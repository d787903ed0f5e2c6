# SPDX-License-Identifier: Apache-2.0
"""All latencies of a recorded run, by name."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from srnn_bag import Bag
from srnn_bringup.latency import answers, lessons, touches
from srnn_replay import planner_replay, tracker_replay
from srnn_replay.origin import RunOrigin
from srnn_replay.recording import Recording, prefixes

ANSWER = 'from a joint state to its command'
STOP = 'from a touch to the command that stops'
STOP_BOUNDED = 'the same where it went straight in at 0.077 m/s or more'
SHOWN = 'from a touch to the joint state that shows it'
STOPPED = 'from the joint state that shows a touch to the command that stops'
STILL = 'from the command that stops to the tip at rest'
ADAPTED = 'from a stop to a segment that has learned from it'
SHARED = 'from a stop to the weights that it led to'
BEGUN = 'from these weights to the planning that follows'
SENT = 'from the beginning of this planning to its segment'

BOUNDED = 0.077
"""From this speed straight into the surface on there is a bound [m/s]: it is tested at 0.1 m/s, up
to 0.7 rad off the straight way in."""


def latencies(bag: Bag) -> Mapping[str, NDArray[np.float64]]:
    """Return samples (n,) [ms] by what was timed; of what did not happen there are none.

    Raises:
        NotReplayableError: a journal is not whole, or nothing tells how the graph was started.

    """
    prefix = prefixes(bag)[0]
    tracker = Recording(bag, tracker_replay.NODE, touches.TOPICS, prefix)
    planner = Recording(bag, planner_replay.NODE, lessons.TOPICS, prefix)
    origin = RunOrigin(bag)
    finder = touches.TouchFinder(tracker, origin.tracker().mount, origin.planner().scene.obstacles)
    touched, taught = finder.touches(), lessons.lessons(planner)
    return {
        ANSWER: answers.answers(tracker).times_ms,
        STOP: _ms([t.stopped_ns - t.clear_ns for t in touched]),
        STOP_BOUNDED: _ms([t.stopped_ns - t.clear_ns for t in touched if t.speed >= BOUNDED]),
        SHOWN: _ms([t.shown_ns - t.clear_ns for t in touched]),
        STOPPED: _ms([t.stopped_ns - t.shown_ns for t in touched]),
        STILL: _ms([t.still_ns - t.stopped_ns for t in touched if t.still_ns is not None]),
        ADAPTED: _ms([one.sent_ns - one.stopped_ns for one in taught]),
        SHARED: _ms([one.shared_ns - one.stopped_ns for one in taught]),
        BEGUN: _ms([one.begun_ns - one.shared_ns for one in taught]),
        SENT: _ms([one.sent_ns - one.begun_ns for one in taught]),
    }


def _ms(times_ns: list[int]) -> NDArray[np.float64]:
    return 1e-6 * np.array(times_ns, dtype=np.float64)
