# SPDX-License-Identifier: Apache-2.0
"""A graph in real time, and what becomes of it when something runs beside it."""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
import time

import psutil

from srnn_bringup.config import Choices, Configuration, load
from srnn_bringup.live_graph import LiveGraph
from srnn_msgs_py.ros import diagnostics
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_node.signals import StopRequest

SETTLE_S = 3.0


@dataclass
class Stretch:
    """A stretch of a run.

    Attributes:
        seconds: how long it was.
        late: cycles of the arm that were late or given up.
        shares: shares of a core that the processes beside it took.

    """

    seconds: float
    late: int
    shares: tuple[float, ...]


class Bench:
    """A running graph and the figures of its arm."""

    def __init__(self, graph: LiveGraph, seconds: float) -> None:
        """Listen to the health of the arm; a stretch takes so many `seconds`."""
        self._pump, self._seconds = graph.pump, seconds
        self._late = 0
        row = topic('/diagnostics')
        graph.node.create_subscription(
            message_type(row.type_name), row.name, self._take, profile(row.qos)
        )

    def run(self, *pids: int) -> Stretch:
        """Run for a while; count the processor time of processes, with all that they start."""
        self._pump.until(lambda: False, SETTLE_S)
        late, before, began = self._late, [*map(_cpu_s, pids)], time.monotonic()
        self._pump.until(lambda: False, self._seconds)
        seconds = time.monotonic() - began
        shares = ((_cpu_s(p) - b) / seconds for p, b in zip(pids, before, strict=True))
        return Stretch(seconds, self._late - late, tuple(shares))

    def _take(self, msg: object) -> None:
        for name, health in diagnostics.from_msg(msg).items():
            if name.endswith('sim_bridge') and 'overruns' in health.values:
                self._late = int(health.values['overruns']) + int(health.values['skipped'])


@contextmanager
def running(seconds: float) -> Iterator[tuple[Bench, Configuration]]:
    """Have the default graph run in real time meanwhile."""
    configuration = load(Choices())
    with StopRequest() as stop, LiveGraph(configuration, stop, print) as graph:
        graph.configure()
        graph.activate()
        yield Bench(graph, seconds), configuration


def arguments(meaning: str) -> argparse.Namespace:
    """Return `seconds` of each stretch and `out`, the file for the table or None."""
    parser = argparse.ArgumentParser(description=meaning)
    parser.add_argument('--seconds', type=float, default=20.0, help='default: %(default)s')
    parser.add_argument('--out', type=Path, metavar='FILE', help='where the table is written')
    return parser.parse_args()


def _cpu_s(pid: int) -> float:
    process = psutil.Process(pid)
    times = [one.cpu_times() for one in (process, *process.children(recursive=True))]
    return sum(one.user + one.system for one in times)
