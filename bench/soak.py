# SPDX-License-Identifier: Apache-2.0
"""Whether the running graph stays what it was: memory, timing and tracking over a long time.

Run: .venv/bin/python bench/soak.py [--minutes M] [--seed S] [--out FILE]

The exit code is 1 if a promise was broken.
"""

import argparse
from dataclasses import dataclass, field
import os
from pathlib import Path
import sys
import time

from diagnostic_msgs.msg import DiagnosticArray
import numpy as np
from sensor_msgs.msg import JointState
from soak_record import Heartbeat, JointRecord, growth_mb, resident_mb

from srnn_bringup.config import Choices, Configuration, load
from srnn_bringup.live_graph import LiveGraph
from srnn_bringup.observer import Observer
from srnn_bringup.run_recorder import Recorder, start_recording
from srnn_experiments.figures import run_figures
from srnn_msgs_py.ros import diagnostics
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_node.signals import StopRequest

WARM_UP_S = 300.0
"""Memory of a run that is long enough is judged from then on [s]."""

SAMPLE_S = 5.0
GROWTH_MB = 10.0
RMSE_M = 0.002
GAP_S = 5.0
"""Nodes report once a second; a busy machine may delay that."""


@dataclass
class Soak:
    """A run and what was seen of it."""

    configuration: Configuration
    recorder: Recorder
    seconds: float = 0.0
    beats: dict[str, Heartbeat] = field(default_factory=dict)
    joints: JointRecord = field(default_factory=JointRecord)
    times: list[float] = field(default_factory=list)
    memory: dict[str, list[float]] = field(default_factory=dict)

    @property
    def warm_up(self) -> float:
        """Return when memory begins to be judged [s]."""
        return min(WARM_UP_S, self.seconds / 3.0)

    def run(self, seconds: float) -> None:
        """Bring the graph up and watch it; the first node that dies ends the run."""
        with StopRequest() as stop, LiveGraph(self.configuration, stop, _say) as graph:
            self.beats = {name: Heartbeat() for name in graph.names}
            self.memory = {name: [] for name in graph.names}
            self._observer = Observer(graph.node, self.recorder)
            graph.configure()
            graph.activate()
            self._listen(graph, '/diagnostics', self._on_health)
            self._listen(graph, 'joint_states', self._on_joints)
            began = time.monotonic()
            while self.seconds < seconds:
                self._sample(graph)
                graph.pump.until(lambda: False, min(SAMPLE_S, seconds - self.seconds))
                self.seconds = time.monotonic() - began
            self._sample(graph)
            for beat in self.beats.values():
                beat.silence(time.monotonic())

    def _sample(self, graph: LiveGraph) -> None:
        self.times.append(self.seconds)
        for name, pid in graph.pids.items():
            self.memory[name].append(resident_mb(pid))

    def _on_health(self, msg: DiagnosticArray) -> None:
        for name, health in diagnostics.from_msg(msg).items():
            self.beats[name.rpartition('/')[2]].beat(health, time.monotonic())

    def _on_joints(self, msg: JointState) -> None:
        self.joints.add(np.array(msg.position))

    @staticmethod
    def _listen(graph: LiveGraph, name: str, callback: object) -> None:
        row = topic(name)
        graph.node.create_subscription(
            message_type(row.type_name), row.name, callback, profile(row.qos)
        )


@dataclass(frozen=True)
class Promise:
    """A figure and what it must not exceed."""

    words: str
    value: float
    bound: float
    unit: str

    @property
    def kept(self) -> bool:
        """Tell whether it does not."""
        return self.value <= self.bound

    def row(self) -> str:
        """Return it as a row of a table."""
        verdict, unit = 'yes' if self.kept else '**no**', self.unit
        value = round(self.value, 3) + 0.0  # No minus before a zero.
        return f'| {self.words} | {value:g}{unit} | {self.bound:g}{unit} | {verdict} |'


def promises(soak: Soak) -> list[Promise]:
    """Return all that a run is judged by."""
    figures = run_figures(soak.recorder.records, soak.configuration.scene.task.blocked)
    rmse = figures['tracking_rmse_m']
    error = np.inf if rmse is None else 1e3 * rmse
    gap = max(beat.gap for beat in soak.beats.values())
    return [
        *(Promise(f'memory of {name}, growth', growth_mb(soak.times, sizes, soak.warm_up),
                  GROWTH_MB, ' MB') for name, sizes in soak.memory.items()),
        Promise('tracking error, rms', error, 1e3 * RMSE_M, ' mm'),
        Promise('longest time without a report of a node', gap, GAP_S, ' s'),
        Promise('joint states with a number that is none', soak.joints.not_finite, 0, ''),
        Promise('joint states beyond a limit', soak.joints.beyond, 0, ''),
        Promise('faults of the tracker', soak.beats['tracker'].figure('faults'), 0, ''),
        Promise('invalid plans', soak.beats['planner'].figure('invalid_plans'), 0, ''),
    ]  # fmt: skip


def report(soak: Soak, command: str) -> str:
    """Return what was seen, in Markdown."""
    bridge, tracker = soak.beats['sim_bridge'], soak.beats['tracker']
    cycles, late, never = (int(bridge.figure(n)) for n in ('cycles', 'overruns', 'skipped'))
    figures = run_figures(soak.recorder.records, soak.configuration.scene.task.blocked)
    lines = [
        f'# {soak.seconds / 60.0:.0f} minutes of the running graph',
        '',
        f'`{command}`, {os.cpu_count()} processors.',
        '',
        '| promise | figure | bound | kept |',
        '|---|---|---|---|',
        *(promise.row() for promise in promises(soak)),
        '',
        f'Memory counts after {soak.warm_up:.0f} s, as growth of the line that fits it best.',
        '',
        '| node | memory at first | at the end | reports | longest gap | troubles reported |',
        '|---|---|---|---|---|---|',
        *(
            f'| {name} | {soak.memory[name][0]:.0f} MB | {soak.memory[name][-1]:.0f} MB | '
            f'{beat.count} | {beat.gap:.2f} s | {_troubles(beat)} |'
            for name, beat in soak.beats.items()
        ),
        '',
        f'{cycles} cycles of the arm, {late} late by more than one cycle, {never} given up '
        f'({(late + never) / max(cycles + never, 1):.3%}); the tracker was without joint states '
        f'for {tracker.figure("longest_silence_ms"):.0f} ms at most.',
        f'{figures["segments_executed"]} segments, {figures["laps"]} laps, '
        f'{figures["contacts"]} contacts ({figures["contacts_last_third"]} in the last third), '
        f'{figures["updates_triggered"]} updates; {len(soak.recorder.refused)} segments refused, '
        f'{soak.beats["planner"].figure("deadline_misses"):.0f} plans late.',
    ]
    return '\n'.join(lines) + '\n'


def _troubles(beat: Heartbeat) -> str:
    return ', '.join(f'{words} ({n} times)' for words, n in beat.troubles.items()) or 'none'


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def main() -> int:
    """Run, and print or write the report."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--minutes', type=float, default=60.0, help='default: %(default)s')
    parser.add_argument('--seed', type=int, default=0, help='default: %(default)s')
    parser.add_argument('--out', type=Path, metavar='FILE', help='where the report is written')
    choice = parser.parse_args()
    configuration = load(Choices(seed=choice.seed))
    soak = Soak(configuration, start_recording(configuration))
    soak.run(60.0 * choice.minutes)
    command = f'bench/soak.py --minutes {choice.minutes:g} --seed {choice.seed}'
    text = report(soak, command)
    print(text)
    if choice.out:
        choice.out.write_text(text, encoding='utf-8')
    return 0 if all(promise.kept for promise in promises(soak)) else 1


if __name__ == '__main__':
    raise SystemExit(main())
