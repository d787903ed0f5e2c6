# SPDX-License-Identifier: Apache-2.0
"""How long things took in a run, out of its bag."""

from collections.abc import Mapping
from contextlib import suppress

import numpy as np
from numpy.typing import NDArray

from srnn_bag import Bag
from srnn_bringup.latency.latencies import latencies
from srnn_bringup.page.bag_run import BagRun
from srnn_msgs_py.journal import Deed, number
from srnn_msgs_py.ros import journal
from srnn_replay.cycles import COMMANDS
from srnn_replay.errors import NotReplayableError
from srnn_replay.recording import decode

PERCENTILES = {'p50': 50.0, 'p95': 95.0, 'p99': 99.0, 'longest': 100.0}
PLANNING = 'planning a segment'
LEARNING = 'learning from a touch'
Times = NDArray[np.float64]


def spread(times: Times) -> list[float]:
    """Return `PERCENTILES` of samples, of which there are some."""
    return [float(value) for value in np.percentile(times, [*PERCENTILES.values()])]


def timings(run: BagRun) -> Mapping[str, Times]:
    """Return samples [ms] by what was timed; those of which there are none are left out."""
    planning = [r.planning_ms for r in run.recorder.records if r.planning_ms is not None]
    update = [r.lesson.update_ms for r in run.recorder.records if r.lesson and r.updated]
    found = {
        PLANNING: np.array(planning),
        LEARNING: np.array(update),
        'from one joint state to the next': _between(run.bag, 'joint_states'),
        'from one command to the next': _between(run.bag, COMMANDS),
        'from one answer of the tracker to the next': _ticks(run.bag),
        'execution of a segment': 1e3 * np.array([r.plan.duration for r in run.recorder.records]),
    }
    # A journal that is not whole, as of a recorder that came late, tells of no latencies.
    with suppress(NotReplayableError):
        found |= latencies(run.bag)
    return {name: times for name, times in found.items() if len(times)}


def _between(bag: Bag, ending: str) -> Times:
    names = {name for name in bag.topics if name.endswith(f'/{ending}')}
    # External torques end alike.
    names = {name for name in names if 'external' not in name}
    return 1e-6 * np.diff([m.sent_ns for m in bag.messages(names)])


def _ticks(bag: Bag) -> Times:
    names = {name for name in bag.topics if name.endswith('/tracker/journal')}
    parts = decode('tracker/journal', bag.messages(names), journal.from_msg)
    rows = [row for part in parts for row in part.value.rows if row[0] == Deed.MEASURED]
    return 1e3 * np.diff([number(int(row[3])) for row in rows])
