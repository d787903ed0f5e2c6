# SPDX-License-Identifier: Apache-2.0
"""All decisions of a recorded run made again, as many nodes at a time as there are cores."""

from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
import gc
import multiprocessing
import os
from pathlib import Path
import time
from typing import Any, Protocol

from srnn_bag import Bag, open_bag
from srnn_replay import adapter_replay, planner_replay, tracker_replay
from srnn_replay.adapter_replay import AdapterReplay
from srnn_replay.origin import RunOrigin
from srnn_replay.planner_replay import PlannerReplay
from srnn_replay.recording import journals
from srnn_replay.tracker_replay import TrackerReplay
from srnn_replay.verdict import Verdict


class Replaying(Protocol):
    """What makes the decisions of a node again."""

    def run(self) -> Verdict:
        """Make all decisions again, until one differs."""


KINDS: Mapping[str, Callable[[RunOrigin, str], Replaying]] = {
    # The longest first.
    tracker_replay.NODE: TrackerReplay,
    planner_replay.NODE: PlannerReplay,
    adapter_replay.NODE: AdapterReplay,
}

_LONGEST = next(iter(KINDS))
_GIVING_WAY = 10
"""By how much nicer the others are, which have time to spare."""


@dataclass(frozen=True)
class Replay:
    """What a replay has found.

    Attributes:
        verdicts: of every node that has a journal in the bag.
        run_s: what the bag covers [s].
        seconds: what the replay took [s].
        note: what may make the last bit of a number another one here; empty for nothing.

    """

    verdicts: tuple[Verdict, ...]
    run_s: float
    seconds: float
    note: str

    @property
    def identical(self) -> bool:
        """Tell whether every decision came out as it was recorded."""
        return all(verdict.identical for verdict in self.verdicts)

    def document(self) -> dict[str, Any]:
        """Return the findings as plain data for JSON."""
        return {
            'identical': self.identical,
            'nodes': [verdict.document() for verdict in self.verdicts],
            'run_s': self.run_s,
            'seconds': self.seconds,
            'note': self.note,
        }


def replay(
    path: Path,
    told: Mapping[str, bytes] | None = None,
    watch: Callable[[int, int], None] = lambda done, total: None,
) -> Replay:
    """Make all decisions of a recorded run again.

    Args:
        path: a bag.
        told: see `RunOrigin`; None for nothing.
        watch: told how many nodes are done, and of how many, whenever one is.

    Raises:
        BagError: there is no such bag, or it is damaged.
        OtherVersionError: it was recorded by another version.
        NotReplayableError: it lacks what decisions could be made again from.

    """
    began = time.perf_counter()
    bag = open_bag(path)
    note = RunOrigin(bag).check_version()
    tasks = [
        (bag, node, prefix, told or {})
        for prefix, node in sorted(journals(bag), key=lambda one: [*KINDS].index(one[1]))
    ]
    context = multiprocessing.get_context('fork')
    with ProcessPoolExecutor(os.cpu_count(), mp_context=context) as pool:
        verdicts = []
        coming = pool.map(_verdict, *zip(*tasks, strict=True))
        span = pool.submit(_span_s, bag)
        # Only now: who watches may start a thread, and the pool has forked.
        watch(0, len(tasks))
        for verdict in coming:
            verdicts.append(verdict)
            watch(len(verdicts), len(tasks))
        run_s = span.result()
    return Replay(tuple(verdicts), run_s, time.perf_counter() - began, note)


def _verdict(bag: Bag, node: str, prefix: str, told: Mapping[str, bytes]) -> Verdict:
    # What a replay keeps it keeps to its end: nothing is found by looking through it again.
    gc.disable()
    if node != _LONGEST:
        os.nice(_GIVING_WAY)
    return KINDS[node](RunOrigin(bag, told), prefix).run()


def _span_s(bag: Bag) -> float:
    """Return the time from the first to the last health report of a bag [s]."""
    names = {name for name in bag.topics if name.endswith('/diagnostics')}
    stamps = [message.received_ns for message in bag.messages(names)]
    return 1e-9 * (max(stamps) - min(stamps)) if stamps else 0.0
