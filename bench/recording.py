# SPDX-License-Identifier: Apache-2.0
"""What recording costs, and whether anything is lost or late for it.

Run: .venv/bin/python bench/recording.py [--seconds S] [--out FILE]

The graph runs without and with a recorder, in turn. The exit code is 1 if the recorder takes
more than 5 % of a core, or a message is lost, or more cycles of the arm are late than without it.
"""

import argparse
from dataclasses import dataclass
import os
from pathlib import Path
import signal
import subprocess
import sys
import tempfile
import time

import psutil

from srnn_bag import open_bag
from srnn_bringup.config import Choices, load
from srnn_bringup.live_graph import LiveGraph
from srnn_msgs_py.ros import diagnostics
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_node.signals import StopRequest

SHARE = 0.05
SETTLE_S = 3.0
ROUNDS = 3


@dataclass
class Part:
    """A stretch of the run: how long, how many cycles were late, what the recorder took."""

    seconds: float
    late: int
    cpu_s: float = 0.0
    messages: int = 0
    megabytes: float = 0.0
    lost: str = ''


class Bench:
    """A running graph and the figures of its arm."""

    def __init__(self, graph: LiveGraph, seconds: float) -> None:
        """Listen to the health of the arm."""
        self._pump, self._seconds = graph.pump, seconds
        self._late = 0
        row = topic('/diagnostics')
        graph.node.create_subscription(
            message_type(row.type_name), row.name, self._take, profile(row.qos)
        )

    def _take(self, msg: object) -> None:
        for name, health in diagnostics.from_msg(msg).items():
            if name.endswith('sim_bridge') and 'overruns' in health.values:
                self._late = int(health.values['overruns']) + int(health.values['skipped'])

    def quiet(self) -> Part:
        """Run for a while without a recorder."""
        self._pump.until(lambda: False, SETTLE_S)
        before = self._late
        self._pump.until(lambda: False, self._seconds)
        return Part(self._seconds, self._late - before)

    def recorded(self, directory: Path) -> Part:
        """Run for as long with a recorder beside it."""
        command = [sys.executable, '-m', 'srnn_bringup.cli', 'record', str(directory)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            recorder = psutil.Process(process.pid)
            self._pump.until(lambda: False, SETTLE_S)
            before, late, began = recorder.cpu_times(), self._late, time.monotonic()
            self._pump.until(lambda: False, self._seconds)
            after, seconds = recorder.cpu_times(), time.monotonic() - began
            part = Part(seconds, self._late - late)
            part.cpu_s = after.user + after.system - before.user - before.system
            process.send_signal(signal.SIGINT)
            text = process.communicate()[0]
        part.lost = text.partition(str(directory))[2].partition(str(directory))[2].strip(' ,\n')
        part.messages = sum(1 for _ in open_bag(directory).messages())
        part.megabytes = sum(f.stat().st_size for f in directory.iterdir()) / 1e6
        return part


def main() -> int:
    """Measure, and print or write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--seconds', type=float, default=20.0, help='default: %(default)s')
    parser.add_argument('--out', type=Path, metavar='FILE', help='where the table is written')
    choice = parser.parse_args()
    lines = [
        '# What recording costs', '',
        f'`bench/recording.py --seconds {choice.seconds:g}`, {os.cpu_count()} processors: the '
        'default graph in real time, without and with',
        '`srnn record` beside it, in turn.', '',
        '| recorder | processor | cycles late | messages | size | lost |',
        '|---|---|---|---|---|---|',
    ]  # fmt: skip
    kept, late = True, {False: 0, True: 0}

    def tell(part: Part, recording: bool) -> None:
        late[recording] += part.late
        share = part.cpu_s / part.seconds
        cells = (
            f'{share:.1%} of a core', str(part.late), str(part.messages),
            f'{part.megabytes:.1f} MB', part.lost or 'none',
        ) if recording else ('', str(part.late), '', '', '')  # fmt: skip
        lines.append(f'| {"yes" if recording else "no"} | {" | ".join(cells)} |')
        print(lines[-1], flush=True)

    with (
        tempfile.TemporaryDirectory() as folder,
        StopRequest() as stop,
        LiveGraph(load(Choices()), stop, print) as graph,
    ):
        graph.configure()
        graph.activate()
        bench = Bench(graph, choice.seconds)
        for n in range(ROUNDS):
            tell(bench.quiet(), False)
            part = bench.recorded(Path(folder, f'bag{n}'))
            tell(part, True)
            kept &= part.cpu_s <= SHARE * part.seconds and not part.lost
    kept &= late[True] <= max(late[False], 1)
    if choice.out:
        choice.out.write_text('\n'.join(lines) + '\n', encoding='utf-8')
    return 0 if kept else 1


if __name__ == '__main__':
    raise SystemExit(main())
