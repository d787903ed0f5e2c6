# SPDX-License-Identifier: Apache-2.0
"""The running graph with a key: strangers change nothing, and whoever is started anew is heard."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
import time

import numpy as np
import pytest
from std_srvs.srv import Trigger
from watched_graph import Watched, free_scene

from lwr_tracking.core.refusal import NOT_IN_CHARGE
from srnn_access import Mark, key_file
from srnn_access.mark import parse
from srnn_bringup.live_graph import LiveGraph, command
from srnn_bringup.observer import Observer
from srnn_bringup.run_recorder import start_recording
from srnn_bringup.supervisor import Command
from srnn_msgs_py.result import ResultCode
from srnn_msgs_py.ros import commands, diagnostics, segment, weights
from srnn_msgs_py.ros.mark_carrier import mark_carrier
from srnn_msgs_py.ros.message_type import message_type
from srnn_msgs_py.ros.qos import profile
from srnn_msgs_py.topics import topic
from srnn_msgs_py.weights import WeightsUpdate
from srnn_node.signals import StopRequest
from srnn_planner.core.parameters import NetworkParameters
from srnn_planner.core.prior import PriorWeights
from srnn_planner.core.synapses import Synapses

COMMANDS = 'forward_position_controller/commands'


class Keyed(Watched):
    """A live graph with a key, and who sent its segments."""

    def __init__(self, graph: LiveGraph) -> None:
        self.sources: dict[int, int] = {}
        self.values: dict[str, dict[str, str]] = {}
        super().__init__(graph, guarded=False)
        self.listen('segment', lambda msg: msg, self._on_marked)
        self.listen('/diagnostics', diagnostics.from_msg, self._on_values)

    def done_by(self, source: int) -> list[int]:
        return [stamp for stamp in self.done() if self.sources.get(stamp) == source]

    def waiting(self) -> list[int]:
        """Return the sources whose segments were refused because another is in charge."""
        return [
            self.sources[r.stamp_ns] for r in self.results
            if r.reason == NOT_IN_CHARGE and r.stamp_ns in self.sources
        ]  # fmt: skip

    def start_second_planner(self) -> None:
        graph = self.graph
        description = graph._descriptions[graph.names.index('planner')]
        first = command(description, graph._files['planner'], autostart=True)
        arguments = (*first.arguments, '-r', '__node:=second_planner')
        graph._supervisor.start(Command('second_planner', arguments, first.environment))

    def publisher(self, name: str):
        row = topic(name)
        return self.graph.node.create_publisher(
            message_type(row.type_name), row.name, profile(row.qos)
        )

    def _on_marked(self, msg) -> None:
        stamp_ns = segment.from_msg(msg).stamp_ns
        mark: Mark | None = parse(mark_carrier(type(msg)).take(msg) or '')
        self.sources[stamp_ns] = mark.source if mark else 0

    def _on_values(self, told) -> None:
        for name, health in told.items():
            self.values[name] = dict(health.values)


@pytest.fixture
def keyed(tmp_path: Path) -> Iterator[Keyed]:
    key = tmp_path / 'graph.key'
    key_file.create(key)
    configuration = replace(free_scene(tmp_path, 0.2), key_file=key)
    with StopRequest() as stop, LiveGraph(configuration, stop, lambda _: None) as graph:
        value = Keyed(graph)
        value.recorder = start_recording(configuration)
        value.observer = Observer(graph.node, value.recorder, configuration.key())
        graph.configure()
        graph.activate()
        value.until(lambda: len(value.done()) >= 2)
        yield value


def test_the_first_of_two_planners_keeps_the_arm_until_it_dies(keyed):
    (first,) = {keyed.sources[stamp] for stamp in keyed.done()}
    keyed.start_second_planner()
    keyed.until(lambda: len(keyed.waiting()) >= 3)
    before = len(keyed.done())
    keyed.until(lambda: len(keyed.done()) >= before + 4)
    assert {keyed.sources[stamp] for stamp in keyed.done()} == {first}
    (second,) = set(keyed.waiting())
    assert second > first
    # The demo's listener goes by the same rules.
    assert {keyed.sources[r.plan.stamp_ns] for r in keyed.recorder.records} == {first}

    keyed.kill('planner')
    keyed.until(lambda: len(keyed.done_by(second)) >= 2)
    keyed.graph.restart('planner')
    keyed.until(lambda: set(keyed.waiting()) - {second})
    (third,) = set(keyed.waiting()) - {second}
    assert third > second
    before = len(keyed.done_by(second))
    keyed.until(lambda: len(keyed.done_by(second)) >= before + 2)
    assert not keyed.done_by(third)


@pytest.mark.parametrize('name', ['planner', 'adapter', 'tracker'])
def test_a_node_that_is_started_anew_is_heard_at_once(keyed, name):
    """Also by those who have heard its predecessor a moment ago."""
    keyed.kill(name)
    keyed.until(lambda: not keyed.graph._supervisor.alive(name))
    before, lessons = len(keyed.done()), len(keyed.recorder.records)
    keyed.graph.restart(name)
    keyed.until(lambda: len(keyed.done()) >= before + 3)
    keyed.until(lambda: len(keyed.recorder.records) > lessons)
    assert not any('unsigned' in k or 'altered' in k for h in keyed.values.values() for k in h)


def test_a_planner_that_comes_late_gets_the_weights_of_long_ago(keyed):
    assert keyed.call(Trigger, 'adapter/revert').success
    keyed.until(lambda: keyed.values.get('/planner', {}).get('weights_version') == '1')
    keyed.spin(6.0)
    keyed.kill('planner')
    keyed.until(lambda: not keyed.graph._supervisor.alive('planner'))
    keyed.values.clear()
    keyed.graph.restart('planner')
    keyed.until(lambda: keyed.values.get('/planner', {}).get('weights_version') == '1')


def test_a_stranger_beside_the_running_graph_changes_nothing(keyed):
    publishers = {name: keyed.publisher(name) for name in ('segment', 'weights', COMMANDS)}
    keyed.until(lambda: all(p.get_subscription_count() > 0 for p in publishers.values()))
    recording = list(keyed.segments)
    prior = PriorWeights(NetworkParameters())
    ones = Synapses.of(prior, np.full((225, 225), 1.0, dtype=np.float32)).learned
    home = np.zeros(7)
    before, started = len(keyed.done()), time.monotonic()
    while time.monotonic() - started < 3.0:
        publishers['segment'].publish(segment.to_msg(recording[-1]))
        publishers['weights'].publish(weights.to_msg(WeightsUpdate(99, 1, ones)))
        publishers[COMMANDS].publish(commands.to_msg(home))
        keyed.spin(0.05)
    keyed.until(lambda: len(keyed.done()) >= before + 3)
    codes = {r.code for r in keyed.results}
    assert not codes & {ResultCode.BLOCKED, ResultCode.FAULT}
    keyed.until(lambda: all(
        int(keyed.values[f'/{node}'].get('access_unsigned', 0)) > 0
        for node in ('tracker', 'planner', 'sim_bridge')
    ))
    assert keyed.values['/planner']['weights_version'] == '0'
    assert keyed.values['/sim_bridge']['refused_too_far'] == '0'
